#include "terrane/light_gpu/light_workspace_internal.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <string>
#include <unordered_map>
#include <utility>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/gpu/debug.h"
#include "terrane/shared/light_solver.h"

namespace terrane::light_gpu {

namespace {

shared::uint propertyOf(world::BlockId id, const light::LightTable& table) {
    return static_cast<shared::uint>(table.emission(id)) << 4 |
           static_cast<shared::uint>(light::levelOf(table.opacity(id), light::kRed));
}

// Converts a dense section; 16 bits a block hold a property too.
world::Section densePropertiesOf(const world::Section& section, const light::LightTable& table) {
    constexpr int kValuesPerWord = 4;
    std::vector<std::uint64_t> words(world::kBlocksPerSection / kValuesPerWord);
    for (int k = 0; k < world::kBlocksPerSection; ++k) {
        const std::uint64_t property = propertyOf(section.get(k), table);
        words[static_cast<std::size_t>(k / kValuesPerWord)] |= property << 16 * (k % kValuesPerWord);
    }
    return *world::Section::fromPacked(static_cast<int>(shared::kDenseBits), {}, std::move(words));
}

}  // namespace

void appendChunk(world::PackedSections& packed, const world::Chunk& chunk, std::span<const int> sections,
                 const light::LightTable& table) {
    const auto propertyOfId = [&](world::BlockId id) { return propertyOf(id, table); };
    for (const int n : sections) {
        const world::Section& section = chunk.section(n);
        if (section.isDense()) {
            appendSection(packed, densePropertiesOf(section, table), propertyOfId);
        } else {
            appendSection(packed, section, propertyOfId);
        }
    }
}

namespace {

using light::LightRequest;
using world::ChunkPos;
using world::ChunkPtr;

ChunkPos neighborOf(ChunkPos pos, int n) {
    return world::offsetBy(pos, n % light::kFieldSide - 1, n / light::kFieldSide - 1);
}

// Sections that have to be solved because of a chunk: those that are not open sky, and those that are not
// rock.
struct Content {
    world::SectionSet notSky, notRock;

    Content& operator|=(const Content& other) {
        notSky |= other.notSky;
        notRock |= other.notRock;
        return *this;
    }
};

Content contentOf(const world::Chunk& chunk, const light::LightTable& table) {
    const auto isClear = [&](world::BlockId id) { return table.opacity(id) == 0 && table.emission(id) == 0; };
    const auto isRock = [&](world::BlockId id) {
        return table.opacity(id) == light::allComponents(light::kMaxLevel) && table.emission(id) == 0;
    };
    Content content;
    bool isSky = true;
    for (int n = chunk.heights().endSection() - 1; n >= chunk.heights().firstSection(); --n) {
        isSky = isSky && chunk.section(n).surelyAll(isClear);
        if (!isSky) content.notSky.add(n);
        if (!chunk.section(n).surelyAll(isRock)) content.notRock.add(n);
    }
    return content;
}

// LightBatch::sections
std::vector<int> sectionsOf(const Content& content, world::Heights heights) {
    std::vector<int> sections;
    for (int n = heights.firstSection(); n < heights.endSection(); ++n) {
        const bool isLowest = sections.empty();
        // Of a run of rock the highest section stays, and none if nothing is below it.
        const bool isRock = !content.notRock.has(n);
        const bool isRockAbove = n + 1 < heights.endSection() && !content.notRock.has(n + 1);
        if (isRock && (isLowest || isRockAbove)) continue;
        sections.push_back(n);
        if (!content.notSky.has(n)) break;  // lamps below shine into it, but not through it
    }
    if (sections.empty()) sections.push_back(heights.endSection() - 1);  // all is rock
    return sections;
}

// The chunks that the requests of a batch name.
class KnownChunks {
  public:
    KnownChunks(world::Heights heights, const light::LightTable& table) : heights_(heights), table_(table) {}

    // False if the request conflicts with those before it, or there is no room. Then nothing changes.
    bool add(const LightRequest& request) {
        if (requested_ == kMaxRequests) return false;
        std::size_t fresh = 0;
        Content content = content_;
        for (int n = 0; n < light::kFieldChunks; ++n) {
            const ChunkPtr& chunk = request.chunks[static_cast<std::size_t>(n)];
            const auto found = chunks_.find(neighborOf(request.pos, n));
            if (found == chunks_.end()) {
                if (!chunk) continue;
                base::require(chunk->heights() == heights_, "LightRequest: the heights of chunks differ");
                ++fresh;
                content |= contentOf(*chunk, table_);
            } else if (found->second.chunk != chunk ||
                       (n == light::kCenterChunk && found->second.isRequested)) {
                return false;
            }
        }
        const std::size_t solved = present_ + fresh;
        if (solved > kMaxSolved) return false;
        if (solved * sectionsOf(content, heights_).size() > kMaxSolvedSections) return false;
        present_ = solved;
        content_ = content;
        ++requested_;
        insert(request);
        return true;
    }
    const std::vector<ChunkPos>& order() const { return order_; }  // of the chunks that exist
    std::vector<int> sections() const { return sectionsOf(content_, heights_); }
    bool isRequested(ChunkPos pos) const { return chunks_.at(pos).isRequested; }
    const ChunkPtr& chunk(ChunkPos pos) const { return chunks_.at(pos).chunk; }

  private:
    struct Known {
        ChunkPtr chunk;  // null: known to be absent
        bool isRequested = false;
    };

    void insert(const LightRequest& request) {
        for (int n = 0; n < light::kFieldChunks; ++n) {
            const ChunkPos pos = neighborOf(request.pos, n);
            const ChunkPtr& chunk = request.chunks[static_cast<std::size_t>(n)];
            if (chunks_.try_emplace(pos, Known{chunk}).second && chunk) order_.push_back(pos);
        }
        chunks_.at(request.pos).isRequested = true;
    }

    world::Heights heights_;
    const light::LightTable& table_;
    Content content_;
    std::unordered_map<ChunkPos, Known, world::ChunkPosHash> chunks_;
    std::vector<ChunkPos> order_;
    std::size_t present_ = 0, requested_ = 0;
};

}  // namespace

LightBatch gatherBatch(std::span<const LightRequest> requests, const light::LightTable& table) {
    const auto requireChunk = [](const LightRequest& request) {
        base::require(request.chunks[light::kCenterChunk] != nullptr,
                      "LightRequest: the chunk to light is null");
    };
    requireChunk(requests.front());
    LightBatch batch;
    batch.heights = requests.front().chunks[light::kCenterChunk]->heights();
    KnownChunks known(batch.heights, table);
    for (const LightRequest& request : requests) {
        requireChunk(request);
        if (!known.add(request)) break;
        batch.requested.push_back(request.pos);
    }
    batch.sections = known.sections();
    std::vector<ChunkPos> solved = batch.requested;
    for (const ChunkPos pos : known.order()) {
        if (!known.isRequested(pos)) solved.push_back(pos);
    }
    std::unordered_map<ChunkPos, shared::uint, world::ChunkPosHash> numbers;
    for (const ChunkPos pos : solved) {
        batch.chunks.push_back(known.chunk(pos));
        numbers.emplace(pos, static_cast<shared::uint>(numbers.size()));
    }
    const auto numberAt = [&](ChunkPos pos) {
        const auto found = numbers.find(pos);
        return found == numbers.end() ? shared::kNoChunk : found->second;
    };
    for (const ChunkPos pos : solved) {
        batch.beside.emplace_back(numberAt(world::offsetBy(pos, -1, 0)), numberAt(world::offsetBy(pos, 1, 0)),
                                  numberAt(world::offsetBy(pos, 0, -1)),
                                  numberAt(world::offsetBy(pos, 0, 1)));
    }
    return batch;
}

namespace {

static_assert(std::endian::native == std::endian::little, "words of two levels are read back as they are");

constexpr std::size_t kWordBytes = sizeof(shared::uint);
constexpr std::size_t kLightLevelBytes = world::kBlocksPerSection * sizeof(light::LightValue);  // a section

// The next multiple of the sections of a small batch, so that buffers grow a few times only.
std::size_t roundedUp(std::size_t sections) {
    return (sections + 511) / 512 * 512;
}

// solver_state.glsl
struct SolverState {
    std::array<shared::SolverRound, shared::kSolverRounds + 1> rounds;
    shared::uint brickCount;
    shared::uint chunkCount, sectionCount;
};

}  // namespace

// The state before the rounds that are submitted at once.
void LightWorkspace::setState(shared::uint tilesListed) {
    SolverState state{};
    for (shared::SolverRound& round : state.rounds) round = {0, 1, 1, 0};
    state.rounds[0].groupsX = tilesListed;
    state.chunkCount = static_cast<shared::uint>(chunkCount_);
    state.sectionCount = static_cast<shared::uint>(solved_.size());
    state_.uploadVector(0, std::vector{state});
}

base::Result<LightPrograms> LightPrograms::create(const gpu::ShaderLoader& shaders) {
    LightPrograms programs;
    for (const auto& [program, name] :
         {std::pair(&programs.sources, "sources"), std::pair(&programs.firstTiles, "first_tiles"),
          std::pair(&programs.spread, "spread"), std::pair(&programs.pack, "pack")}) {
        auto made = TERRANE_TRY(gpu::Program::compute(
            shaders, fmt::format("terrane/light_gpu/{}.comp.glsl", name), {}, fmt::format("light {}", name)));
        *program = std::move(made);
    }
    return programs;
}

void LightWorkspace::upload(const LightBatch& batch, const light::LightTable& table) {
    input_.clear();
    for (const world::ChunkPtr& chunk : batch.chunks) appendChunk(input_, *chunk, batch.sections, table);
    sections_ = gpu::Buffer(std::as_bytes(std::span(input_.sections)), 0, "light sections");
    data_ = gpu::Buffer(std::as_bytes(std::span(input_.data)), 0, "light section data");
    neighbors_ = gpu::Buffer(std::as_bytes(std::span(batch.beside)), 0, "light neighbors");
}

void LightWorkspace::makeRoom() {
    const std::size_t sections = roundedUp(chunkCount_ * solved_.size()),
                      tiles = sections * shared::kLightTilesPerSection;
    if (levels_.sizeBytes() < sections * kLightLevelBytes) {
        levels_ = gpu::Buffer(sections * kLightLevelBytes, 0, "light levels");
        tiles_ = gpu::Buffer(tiles * kWordBytes, 0, "light tiles");
        lists_ = gpu::Buffer(3 * tiles * kWordBytes, 0, "light work lists");
    }
    const auto results = static_cast<shared::uint>(roundedUp(requested_.size() * solved_.size()));
    const std::size_t resultBytes = std::size_t{shared::resultWords(results, results)} * kWordBytes;
    if (result_.data().size() < resultBytes) result_ = gpu::ReadbackBuffer(resultBytes, "light result");
    if (state_.sizeBytes() == 0)
        state_ = gpu::Buffer(sizeof(SolverState), GL_DYNAMIC_STORAGE_BIT, "light state");
}

void LightWorkspace::bind() const {
    sections_.bindStorage(shared::kPackedSectionsBinding);
    data_.bindStorage(shared::kPackedDataBinding);
    levels_.bindStorage(shared::kSolverLightLevelsBinding);
    tiles_.bindStorage(shared::kSolverTilesBinding);
    lists_.bindStorage(shared::kSolverListsBinding);
    state_.bindStorage(shared::kSolverStateBinding);
    neighbors_.bindStorage(shared::kSolverNeighborsBinding);
    result_.bindStorage(shared::kSolverResultBinding);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, state_.id());
}

// Sets emission and the daylight of columns, and lists the light tiles of the first round.
void LightWorkspace::setSources(const LightPrograms& programs) {
    const auto chunks = static_cast<GLuint>(chunkCount_);
    programs.sources.use();
    glDispatchCompute(chunks, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    programs.firstTiles.use();
    const auto tiles = static_cast<GLuint>(solved_.size()) * shared::kLightTilesPerSection;
    glDispatchCompute((tiles + 63) / 64, chunks, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

// A round with an empty list costs one command. Packing is cheap if more rounds are needed.
void LightWorkspace::spreadAndPack(const LightPrograms& programs) {
    programs.spread.use();
    for (shared::uint k = 0; k < shared::kSolverRounds; ++k) {
        programs.spread.set(0, roundsDone_++);
        glDispatchComputeIndirect(static_cast<GLintptr>(k * sizeof(shared::SolverRound)));
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    }
    programs.pack.use();
    glDispatchCompute(static_cast<GLuint>(requested_.size()), static_cast<GLuint>(solved_.size()), 1);
    glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    fence_ = gpu::Fence::insert();
}

void LightWorkspace::start(const LightPrograms& programs, const LightBatch& batch,
                           const light::LightTable& table) {
    TERRANE_ZONE("start light on the GPU");
    assert(isFree() && !batch.requested.empty() && "one batch at a time, with chunks");
    const gpu::DebugGroup group("light");
    heights_ = batch.heights;
    solved_ = batch.sections;
    requested_ = batch.requested;
    chunkCount_ = batch.chunks.size();
    roundsDone_ = 0;
    upload(batch, table);
    makeRoom();
    bind();
    setState(0);
    setSources(programs);
    spreadAndPack(programs);
}

bool LightWorkspace::isFinished(const LightPrograms& programs, bool wait) {
    for (;;) {
        if (wait) fence_.wait();
        if (!fence_.passed()) return false;
        const shared::uint tilesLeft = resultWord(0);
        if (tilesLeft == 0) return true;
        const gpu::DebugGroup group("light again");
        bind();
        setState(tilesLeft);
        spreadAndPack(programs);
    }
}

shared::uint LightWorkspace::resultWord(std::size_t index) const {
    shared::uint word = 0;
    std::memcpy(&word, result_.data().data() + index * kWordBytes, kWordBytes);
    return word;
}

light::LightBrick LightWorkspace::brickAt(std::size_t entry) const {
    const shared::uint brick = resultWord(entry);
    if ((brick & shared::kBrickUniformBit) != 0)
        return light::LightBrick(static_cast<light::LightValue>(brick));
    const std::size_t entries = requested_.size() * solved_.size();
    const std::size_t first = shared::resultWords(static_cast<shared::uint>(entries), brick);
    std::array<light::LightValue, world::kBlocksPerSection> values;
    std::memcpy(values.data(), result_.data().data() + first * kWordBytes, sizeof(values));
    return light::LightBrick::fromValues(values);
}

// Above the solved sections is full daylight; the others are dark.
light::ChunkLight LightWorkspace::lightOf(std::size_t chunk) const {
    light::ChunkLight light(heights_);
    for (int n = solved_.back() + 1; n < heights_.endSection(); ++n)
        light.setBrick(n, light::LightBrick(light::kFullDaylight));
    const auto count = static_cast<shared::uint>(solved_.size());
    for (shared::uint k = 0; k < count; ++k)
        light.setBrick(solved_[k], brickAt(shared::resultEntry(static_cast<shared::uint>(chunk), k, count)));
    return light;
}

std::vector<light::LightResult> LightWorkspace::takeResult() {
    TERRANE_ZONE("take light from the GPU");
    std::vector<light::LightResult> results;
    results.reserve(requested_.size());
    for (std::size_t k = 0; k < requested_.size(); ++k) results.push_back({requested_[k], lightOf(k)});
    requested_.clear();
    return results;
}

}  // namespace terrane::light_gpu
