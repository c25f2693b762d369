#include "terrane/volume/read_chunks.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "terrane/volume/block_area.h"

namespace terrane::volume {

namespace {

using Values = std::array<world::Section::Value, world::kBlocksPerSection>;

// Calls row(place in the section, place in the array, blocks) for each row along x of a section that lies in
// the part.
template <class Row>
void forEachRow(const ChunkPart& part, const BlockArea& area, int section, const Row& row) {
    const int low = section * world::kSectionSize;
    const int z0 = std::max(part.z0, low), z1 = std::min(part.z1, low + world::kSectionSize);
    const auto count = static_cast<std::size_t>(part.x1 - part.x0);
    for (int z = z0; z < z1; ++z) {
        const std::int64_t layer = part.first + (z - part.z0) * area.width() * area.depth();
        for (int y = part.y0; y < part.y1; ++y)
            row(static_cast<std::size_t>(part.x0 + y * world::kChunkSize + ((z - low) << 8)),
                static_cast<std::size_t>(layer + (y - part.y0) * area.width()), count);
    }
}

// Rows of whole chunks have a constant length, which compiles to two moves.
void copyRow(const std::uint16_t* from, std::uint16_t* to, std::size_t count) {
    if (count == world::kChunkSize)
        std::memcpy(to, from, world::kChunkSize * sizeof(std::uint16_t));
    else
        std::memcpy(to, from, count * sizeof(std::uint16_t));
}

int firstSection(const ChunkPart& part) {
    return part.z0 >> 4;
}
int endSection(const ChunkPart& part) {
    return ((part.z1 - 1) >> 4) + 1;
}

}  // namespace

LightLevels lightLevels(light::LightValue value) {
    const auto level = [value](int component) {
        return static_cast<std::uint8_t>(light::levelOf(value, component));
    };
    return {level(light::kDaylight), level(light::kRed), level(light::kGreen), level(light::kBlue)};
}

namespace {

// Calls sectionOf(number) for sections of a chunk, and copies those with values other than 0.
template <class SectionOf>
void copySections(const SectionOf& sectionOf, world::ChunkPos pos, const BlockArea& area,
                  std::span<std::uint16_t> copied) {
    const ChunkPart part = partOf(area, pos);
    Values values;
    for (int s = firstSection(part); s < endSection(part); ++s) {
        const world::Section& section = sectionOf(s);
        if (section.isUniform() && section.uniformValue() == 0) continue;
        section.unpack(values);
        forEachRow(part, area, s, [&](std::size_t from, std::size_t to, std::size_t count) {
            copyRow(&values[from], &copied[to], count);
        });
    }
}

}  // namespace

void copyBlocks(const world::Chunk& chunk, world::ChunkPos pos, const BlockArea& area,
                std::span<world::BlockId> blocks) {
    static_assert(world::kAir == 0);
    copySections([&](int number) -> const world::Section& { return chunk.section(number); }, pos, area,
                 blocks);
}

void copyStates(const world::Chunk& chunk, world::ChunkPos pos, const BlockArea& area,
                std::span<std::uint16_t> states) {
    copySections([&](int number) -> const world::Section& { return chunk.blockStates(number); }, pos, area,
                 states);
}

void copyLight(const light::ChunkLight& light, world::ChunkPos pos, const BlockArea& area,
               std::span<LightLevels> levels) {
    const ChunkPart part = partOf(area, pos);
    Values values;
    for (int s = firstSection(part); s < endSection(part); ++s) {
        light.brick(s).unpack(values);
        forEachRow(part, area, s, [&](std::size_t from, std::size_t to, std::size_t count) {
            for (std::size_t k = 0; k < count; ++k) levels[to + k] = lightLevels(values[from + k]);
        });
    }
}

namespace {

// Whether the block was another one, or its state.
bool writeBlock(world::Chunk& chunk, world::BlockIndex at, world::BlockId id,
                std::optional<std::uint16_t> state) {
    const bool isOther = chunk.block(at) != id;
    if (isOther) chunk.setBlock(at, id);
    if (!state || chunk.blockState(at) == *state) return isOther;
    chunk.setBlockState(at, *state);
    return true;
}

}  // namespace

std::int64_t writeBlocks(const BlockValues& values, const BlockArea& area, world::ChunkPos pos,
                         world::Chunk& chunk) {
    const ChunkPart part = partOf(area, pos);
    const std::span ids = values.ids;
    const std::span states = values.states;
    const std::size_t idStep = ids.size() == 1 ? 0 : 1, stateStep = states.size() == 1 ? 0 : 1;
    std::int64_t changed = 0;
    for (int s = firstSection(part); s < endSection(part); ++s)
        forEachRow(part, area, s, [&](std::size_t to, std::size_t from, std::size_t count) {
            for (std::size_t k = 0; k < count; ++k) {
                const auto at = static_cast<world::BlockIndex>((static_cast<std::size_t>(s) << 12) + to + k);
                const auto state =
                    states.empty() ? std::nullopt : std::optional(states[(from + k) * stateStep]);
                changed += writeBlock(chunk, at, ids[(from + k) * idStep], state);
            }
        });
    return changed;
}

namespace {

// Chunks that one call of the store loads. Few, so that threads end together.
constexpr std::int64_t kChunksOfPart = 4;

// The error of the lowest number, whatever the order of threads.
class FirstError {
  public:
    void note(std::int64_t number, base::Error error) {
        const std::lock_guard lock(mutex_);
        if (number >= number_) return;
        number_ = number;
        error_ = std::move(error);
        isSet_ = true;
    }
    bool isSet() const { return isSet_; }
    // Whether one of a lower number is known.
    bool isBelow(std::int64_t number) const { return number_ < number; }
    const base::Error& error() const { return error_; }

  private:
    std::mutex mutex_;
    std::atomic<std::int64_t> number_ = std::numeric_limits<std::int64_t>::max();
    base::Error error_;
    std::atomic<bool> isSet_{false};
};

base::Result<world::Chunk> chunkFrom(store::LoadedChunk& stored, world::ChunkPos pos,
                                     const OpenedWorld& world) {
    if (!world::isInWorld(pos)) return world::Chunk();  // its key is that of another chunk
    if (stored.isUnreadable && !stored.isOverBudget)
        return base::fail(base::ErrorCode::Io, "{}: {}", store::nameOf(pos), stored.problem);
    if (stored.chunk) return std::move(*stored.chunk);
    const auto generator = TERRANE_TRY(world.generator(pos.level));
    return generator->generate(pos);
}

}  // namespace

ChunkList chunksOf(const world::ChunkArea& area) {
    return {area.chunkCount(), [area](std::int64_t number) { return chunkIn(area, number); }};
}

base::Result<void> forEachPart(OpenedWorld& world, std::int64_t count, const ShouldContinue& shouldContinue,
                               const std::function<base::Result<void>(std::int64_t)>& work) {
    const auto caller = std::this_thread::get_id();
    FirstError first;
    std::atomic<bool> isStopped{false};
    TERRANE_TRY(base::parallelFor(world.jobs(), static_cast<std::size_t>(count), [&](std::size_t k) {
        const auto number = static_cast<std::int64_t>(k);
        if (isStopped || first.isBelow(number)) return;
        if (shouldContinue && std::this_thread::get_id() == caller && !shouldContinue()) {
            isStopped = true;
            return;
        }
        if (auto done = work(number); !done) first.note(number, std::move(done.error()));
    }));
    if (first.isSet()) return tl::unexpected(first.error());
    if (isStopped) return base::fail(kStopped);
    return {};
}

base::Result<void> readChunks(OpenedWorld& world, const ChunkList& list, const ShouldContinue& shouldContinue,
                              const UseChunk& use) {
    const std::int64_t parts = (list.count + kChunksOfPart - 1) / kChunksOfPart;
    return forEachPart(world, parts, shouldContinue, [&](std::int64_t part) -> base::Result<void> {
        std::vector<world::ChunkPos> positions;
        const std::int64_t first = part * kChunksOfPart;
        for (std::int64_t k = first; k < std::min(first + kChunksOfPart, list.count); ++k)
            positions.push_back(list.at(k));
        std::vector<store::LoadedChunk> stored = world.store().loadMany(positions);
        for (std::size_t k = 0; k < positions.size(); ++k) {
            auto chunk = TERRANE_TRY(chunkFrom(stored[k], positions[k], world));
            use(first + static_cast<std::int64_t>(k), std::move(chunk));
        }
        return {};
    });
}

}  // namespace terrane::volume
