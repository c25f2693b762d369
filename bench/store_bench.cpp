// Saving and loading on one thread, with real chunks: overworld, 8 places of 12 × 12. The label of the codec
// is a digest of all bytes: it changes where the result does.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/bench_content.h"
#include "terrane/base/digest.h"
#include "terrane/base/platform.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/sqlite/sqlite_store.h"

namespace {

using namespace terrane;
using bench::blocks;
using bench::orExit;

constexpr std::uint64_t kSeed = 1;

struct Place {
    world::ChunkPos pos;
    world::ChunkPtr chunk;
};

const std::vector<Place>& places() {
    static const std::vector<Place> all = [] {
        const gen::Generator generator(orExit(gen::makeGenerator("overworld", blocks())), kSeed);
        std::vector<Place> result;
        for (int area = 0; area < 8; ++area) {
            for (int n = 0; n < 12 * 12; ++n) {
                const world::ChunkPos pos{area * 97 - 300 + n % 12, area * 61 - 200 + n / 12};
                result.push_back({pos, std::make_shared<world::Chunk>(generator.generate(pos))});
            }
        }
        return result;
    }();
    return all;
}

const store::BlockIdMap& ids() {
    static const store::BlockIdMap map = orExit(store::BlockIdMap::make(blocks(), {}));
    return map;
}

std::vector<store::Bytes> encodeAll() {
    std::vector<store::Bytes> all;
    for (const Place& place : places()) all.push_back(orExit(store::encodeChunk(*place.chunk, ids())));
    return all;
}

void setRate(benchmark::State& state) {
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(places().size()));
}

void encode(benchmark::State& state) {
    std::size_t bytes = 0;
    base::Digest digest;
    for (const store::Bytes& chunk : encodeAll()) {
        bytes += chunk.size();
        digest.update(chunk);
    }
    for (auto _ : state) benchmark::DoNotOptimize(encodeAll());
    setRate(state);
    state.counters["bytes_chunk"] = static_cast<double>(bytes) / static_cast<double>(places().size());
    state.SetLabel(digest.hex());
}
BENCHMARK(encode)->Unit(benchmark::kMillisecond);

void decode(benchmark::State& state) {
    const std::vector<store::Bytes> all = encodeAll();
    for (auto _ : state)
        for (const store::Bytes& bytes : all)
            benchmark::DoNotOptimize(orExit(store::decodeChunk(bytes, ids(), {})));
    setRate(state);
}
BENCHMARK(decode)->Unit(benchmark::kMillisecond);

void verify(benchmark::State& state) {
    const std::vector<store::Bytes> all = encodeAll();
    for (auto _ : state)
        for (const store::Bytes& bytes : all) benchmark::DoNotOptimize(store::verifyChunk(bytes, {}));
    setRate(state);
}
BENCHMARK(verify)->Unit(benchmark::kMillisecond);

// Generation of the same chunks, to compare loading with.
void generate(benchmark::State& state) {
    for (auto _ : state) {
        const gen::Generator generator(orExit(gen::makeGenerator("overworld", blocks())), kSeed);
        for (const Place& place : places()) benchmark::DoNotOptimize(generator.generate(place.pos));
    }
    setRate(state);
}
BENCHMARK(generate)->Unit(benchmark::kMillisecond)->Iterations(1);

class SaveFolder {
  public:
    SaveFolder()
        : path_(std::filesystem::temp_directory_path() /
                ("terrane_bench_" + std::to_string(base::platform::processNumber()))) {
        std::filesystem::create_directories(path_);
    }
    ~SaveFolder() { std::filesystem::remove_all(path_); }
    std::filesystem::path file() const { return path_ / "bench.sqlite"; }
    void clear() const {
        for (const auto& entry : std::filesystem::directory_iterator(path_)) std::filesystem::remove(entry);
    }

  private:
    std::filesystem::path path_;
};

std::unique_ptr<store::SqliteStore> openSave(const SaveFolder& folder) {
    const store::WorldIdentity identity{kSeed, "overworld", 1};
    return orExit(store::SqliteStore::open(folder.file(), blocks(), {.create = identity, .decide = {}}));
}

void saveAll(store::ChunkStore& store) {
    for (const Place& place : places()) store.save(place.pos, place.chunk, store::Provenance::Generated);
    if (const auto done = store.flush(); !done) {
        std::fprintf(stderr, "%s\n", done.error().message.c_str());
        std::exit(1);
    }
}

// Saves in batches of 1,024 until the data is on the disk.
void saveToFile(benchmark::State& state) {
    const SaveFolder folder;
    for (auto _ : state) {
        state.PauseTiming();
        folder.clear();
        auto store = openSave(folder);
        state.ResumeTiming();
        saveAll(*store);
        state.PauseTiming();
        store.reset();
        state.ResumeTiming();
    }
    setRate(state);
    state.counters["file_bytes_chunk"] =
        static_cast<double>(std::filesystem::file_size(folder.file())) / static_cast<double>(places().size());
}
BENCHMARK(saveToFile)->Unit(benchmark::kMillisecond)->UseRealTime();

void loadFromFile(benchmark::State& state) {
    const SaveFolder folder;
    { saveAll(*openSave(folder)); }
    const auto store = openSave(folder);
    for (auto _ : state)
        for (const Place& place : places()) benchmark::DoNotOptimize(store->load(place.pos));
    setRate(state);
}
BENCHMARK(loadFromFile)->Unit(benchmark::kMillisecond)->UseRealTime();

// 48 chunks a call, as jobs of a pipeline may load them.
void loadManyFromFile(benchmark::State& state) {
    const SaveFolder folder;
    { saveAll(*openSave(folder)); }
    const auto store = openSave(folder);
    std::vector<world::ChunkPos> positions;
    for (const Place& place : places()) positions.push_back(place.pos);
    constexpr std::size_t kAtOnce = 48;
    for (auto _ : state)
        for (std::size_t first = 0; first < positions.size(); first += kAtOnce)
            benchmark::DoNotOptimize(store->loadMany(std::span(positions).subspan(first, kAtOnce)));
    setRate(state);
}
BENCHMARK(loadManyFromFile)->Unit(benchmark::kMillisecond)->UseRealTime();

void loadWhatIsNotThere(benchmark::State& state) {
    const SaveFolder folder;
    { saveAll(*openSave(folder)); }
    const auto store = openSave(folder);
    for (auto _ : state)
        for (const Place& place : places())
            benchmark::DoNotOptimize(store->load({place.pos.x + 100000, place.pos.y}));
    setRate(state);
}
BENCHMARK(loadWhatIsNotThere)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
