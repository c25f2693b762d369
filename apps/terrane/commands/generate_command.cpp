// terrane generate: generates an area, into a save, for its digest or to measure the speed.
#include <fmt/ranges.h>

#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/options.h"
#include "terrane/base/digest.h"
#include "terrane/base/log.h"
#include "terrane/content/built_in.h"
#include "terrane/gen/compile/glsl_emitter.h"
#include "terrane/gen/cpu/kernels.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/io/open_session.h"
#include "terrane/store_postgres/any_world.h"
#include "terrane/world/chunk.h"

namespace terrane::app {
namespace {

struct GenerateOptions {
    io::WorldOptions world;
    AreaOptions chunks;
    int level = 0;
    bool digest = false;
    bool json = false;
    bool explain = false;
    io::SaveOptions save;
    Backend backend = Backend::Auto;
    std::string simd;
};

// Chunks generated at a time: enough for all workers or three batches of the GPU, 192 × about 10 KiB.
constexpr std::int64_t kBatch = 192;

struct Generated {
    std::size_t chunks = 0;   // generated in this run
    std::size_t skipped = 0;  // already in the save
    std::string digest;       // over all blocks
};

// Generates the chunks of the area that the save lacks, batch by batch; each batch is durable before the
// next, so a stopped run can continue.
class AreaGenerator {
  public:
    // `save` may be null.
    AreaGenerator(gen::BatchGenerator& generator, int level, store::ChunkStore* save, bool wantsDigest)
        : generator_(generator),
          level_(static_cast<std::uint8_t>(level)),
          save_(save),
          wantsDigest_(wantsDigest) {}

    // The digest covers chunks by y, then x; blocks by z, y, x, as 16-bit little-endian ids.
    base::Result<Generated> run(const world::ChunkArea& area) {
        base::ProgressBar bar("generating", static_cast<std::size_t>(area.chunkCount()));
        const std::int64_t width = std::int64_t{area.x1} - area.x0;
        std::vector<world::ChunkPos> positions;
        for (std::int64_t first = 0; first < area.chunkCount(); first += kBatch) {
            positions.clear();
            for (std::int64_t n = first; n < std::min(first + kBatch, area.chunkCount()); ++n) {
                positions.push_back({static_cast<std::int32_t>(area.x0 + n % width),
                                     static_cast<std::int32_t>(area.y0 + n / width), level_});
            }
            TERRANE_TRY(batch(positions));
            bar.set(static_cast<std::size_t>(first) + positions.size());
        }
        result_.digest = digest_.hex();
        return result_;
    }

  private:
    base::Result<void> batch(const std::vector<world::ChunkPos>& positions) {
        // A damaged chunk is not stored; loading reports it and sets it aside.
        std::vector<store::LoadedChunk> stored(positions.size());
        if (save_) stored = save_->loadMany(positions);
        const auto found = TERRANE_TRY(store::missingChunks(positions, stored));
        const std::vector<world::ChunkPos>& missing = found;
        auto chunks = TERRANE_TRY(gen::generateAll(generator_, missing));
        chunks_ = std::move(chunks);
        result_.chunks += missing.size();
        result_.skipped += positions.size() - missing.size();
        if (wantsDigest_) addBatchToDigest(stored);
        return save_ ? saveBatch(missing) : base::Result<void>();
    }

    void addBatchToDigest(const std::vector<store::LoadedChunk>& stored) {
        std::size_t k = 0;
        for (const store::LoadedChunk& loaded : stored)
            world::addToDigest(digest_, loaded.chunk ? *loaded.chunk : *chunks_[k++]);
    }

    base::Result<void> saveBatch(const std::vector<world::ChunkPos>& positions) {
        for (std::size_t k = 0; k < positions.size(); ++k) {
            save_->save(positions[k], std::move(chunks_[k]), store::Provenance::Generated);
        }
        return save_->flush();
    }

    gen::BatchGenerator& generator_;
    std::uint8_t level_;
    store::ChunkStore* save_;
    bool wantsDigest_;
    std::vector<std::shared_ptr<world::Chunk>> chunks_;
    base::Digest digest_;
    Generated result_;
};

// Counts the layers of one chunk by how a 3D pass makes them.
std::string described(const gen::PassReport& report, const std::string& name) {
    using Way = gen::SlabRun::Way;
    std::map<Way, int> layers;
    std::size_t instructions = 0;
    for (const gen::SlabRun& slab : report.slabs) {
        layers[slab.way] += slab.count;
        if (slab.way == Way::Short) instructions += slab.instructions * static_cast<std::size_t>(slab.count);
    }
    std::vector<std::string> parts;
    const auto add = [&](Way way, const std::string& words) {
        if (layers[way] > 0) parts.push_back(fmt::format("{} {}", layers[way], words));
    };
    add(Way::Filled, "filled");
    add(Way::Copied, "copied from the previous pass");
    add(Way::Repeated, "like the layer below");
    if (const int count = layers[Way::Short]) {
        const double mean = static_cast<double>(instructions) / count;
        add(Way::Short,
            fmt::format("computed with {:.0f} of {} instructions", mean, report.wholeInstructions));
    }
    add(Way::Whole, fmt::format("computed with all {} instructions", report.wholeInstructions));
    return fmt::format("{}: layers: {}", name, fmt::join(parts, ", "));
}

// Prints how much of each 3D pass the CPU skips in one chunk.
void explainChunk(const gen::GeneratorGraph& graph, std::uint64_t seed, world::ChunkPos pos) {
    std::vector<gen::PassReport> reports;
    gen::Generator(graph, seed).generate(pos, reports);
    fmt::print("// chunk {},{}{}\n", pos.x, pos.y,
               pos.level > 0 ? fmt::format(" of level {}", pos.level) : "");
    for (const gen::PassReport& report : reports) {
        const std::string& name = graph.passes[static_cast<std::size_t>(report.pass)].name;
        fmt::print("// {}\n", described(report, name));
    }
}

// Prints the passes, the fields that they read and write, and their GLSL.
base::Result<void> explain(const io::WorldOptions& options, const pack::Content& content,
                           world::ChunkPos chunk) {
    auto graph = TERRANE_TRY(io::makeGraph(options, content, chunk.level));
    for (std::size_t k = 0; k < graph.passes.size(); ++k) {
        const gen::PassGraph& pass = graph.passes[k];
        fmt::print("// pass {}: {}, {}, {} nodes\n", k, pass.name, pass.is3D ? "3D" : "2D",
                   pass.graph.size());
        for (const gen::FieldOutput& f : pass.fields)
            fmt::print("// writes field {}\n", graph.fields[f.field].name);
        for (const std::uint32_t f : pass.readsAt)
            fmt::print("// reads around field {}\n", graph.fields[f].name);
        fmt::print("{}\n", gen::emitGlsl(graph, k));
    }
    explainChunk(graph, options.effectiveSeed(), chunk);
    return {};
}

void report(const GenerateOptions& options, const Generated& result, double seconds,
            std::string_view backend) {
    const double speed = static_cast<double>(result.chunks) / seconds;
    const unsigned threads = io::threadCount(options.world);
    if (result.skipped > 0)
        base::logInfo("{}: {} chunks existed already",
                      store_postgres::shownOf(store::worldLocation(options.save.world)), result.skipped);
    base::logInfo("{} chunks in {:.2f} s, {:.0f} chunks/s, back end {}, threads {}", result.chunks, seconds,
                  speed, backend, threads);
    if (options.json) {
        nlohmann::json line = {{"chunks", result.chunks},
                               {"seconds", seconds},
                               {"chunks_per_second", speed},
                               {"threads", threads},
                               {"backend", backend}};
        if (options.digest) line["digest"] = result.digest;
        if (!options.save.world.empty()) line["skipped"] = result.skipped;
        std::cout << line.dump() << '\n';
    } else if (options.digest) {
        std::cout << result.digest << '\n';
    }
}

base::Result<void> generate(GenerateOptions& options) {
    const auto chosen = areaOf(options.chunks);
    if (!chosen && !options.explain) {
        return base::fail("generate needs --radius, --area or --explain");
    }
    const world::ChunkArea area = chosen.value_or(world::ChunkArea{0, 0, 1, 1});
    const auto content = TERRANE_TRY(io::loadContent(options.world, options.save));
    if (options.explain) {
        // The first chunk of the area, if one is given.
        const auto level = static_cast<std::uint8_t>(options.level);
        const world::ChunkPos chunk =
            options.chunks.area ? world::ChunkPos{area.x0, area.y0, level} : world::ChunkPos{0, 0, level};
        return explain(options.world, content, chunk);
    }
    if (!gen::chooseSimdTarget(options.simd)) {
        return base::fail("--simd: this machine does not have {}, only {}", options.simd,
                          fmt::join(gen::simdTargets(), ", "));
    }
    if (options.level > 0 && !options.save.world.empty())
        return base::fail("--level: worlds store chunks of level 0, not generated tiles");
    TERRANE_TRY(checkSaveOptions(options.save));
    auto save = TERRANE_TRY(io::openSave(options.world, options.save, store::WorldAccess::ReadWrite, content,
                                         store::WorldSharing::Generating));
    auto generator = TERRANE_TRY(makeBatchGenerator(options.world, options.backend, content, options.level));

    const auto start = std::chrono::steady_clock::now();
    auto result =
        TERRANE_TRY(AreaGenerator(*generator.worker, options.level, save.get(), options.digest).run(area));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report(options, result, seconds, generator.worker->backend());
    return {};
}

}  // namespace

CommandEntry addGenerate(CLI::App& app) {
    auto options = std::make_shared<GenerateOptions>();
    CLI::App* command = app.add_subcommand("generate", "Generate an area of the world");
    addAreaOptions(*command, options->chunks, 4096, "Chunks around 0,0: (2R+1)² of them");
    command
        ->add_option("--level", options->level,
                     "Level of detail: tiles of columns 2^N blocks wide; radius and area count these")
        ->check(CLI::Range(0, world::kMaxLevel));
    command->add_flag("--digest", options->digest, "Print one hash over all blocks");
    command->add_flag("--json", options->json, "Print the result as JSON");
    command->add_flag(
        "--explain", options->explain,
        "Print the generator's passes, their GLSL and what the CPU skips in a chunk, and generate nothing");
    addBackendOption(*command, options->backend, "Device that generates");
    command->add_option("--simd", options->simd,
                        "Instruction set, as terrane info lists them (default: the best)");
    addWorldOptions(*command, options->world);
    addWorldOption(*command, options->save,
                   "World to generate into; created if needed. Existing chunks stay");
    addRecreateOption(*command, options->save);
    return {command, [options] { return generate(*options); }};
}

}  // namespace terrane::app
