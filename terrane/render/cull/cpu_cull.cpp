#include "terrane/render/cull/cpu_cull.h"

#include <algorithm>
#include <utility>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/mesh/draw_bucket.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

constexpr std::size_t kFirstSliceBytes = 1 << 16;  // of a frame: 16,000 listed quads

// Calls use(range, direction) for the ranges of a bucket that have quads, in these directions.
template <class Use>
void forEachRange(const shared::MeshSectionRecord& record, shared::uint bucket, shared::uint directions,
                  Use use) {
    const bool isTwoSided = (bucket & 1) != 0;
    const shared::uint first = shared::firstRange(bucket);
    for (shared::uint k = 0; k < (isTwoSided ? 1 : shared::kFaceDirections); ++k) {
        const shared::uint direction = isTwoSided ? shared::kFaceDirections - 1 : k;
        if ((directions >> direction & 1) != 0 && record.ranges[first + k].y > 0)
            use(record.ranges[first + k], direction);
    }
}

}  // namespace

// A mesh section in view.
struct CpuCull::Section {
    const shared::MeshSectionRecord& record;
    std::size_t arena;
    std::uint32_t firstQuad;        // address of the arena's first
    std::span<shared::Quad> quads;  // of the arena
    glm::vec3 slabCorner;
    float columnWidth;
};

// Waits for the GPU.
void CpuCull::readDepth(const gpu::Texture2D& hiZ, glm::ivec2 pixels) {
    constexpr int kPixels = shared::kHiZTexelPixels;
    const glm::ivec2 used = (pixels + kPixels - 1) / kPixels;
    pyramid_.resize(used);
    glGetTextureSubImage(hiZ.id(), 0, 0, 0, 0, used.x, used.y, 1, GL_RED, GL_FLOAT,
                         static_cast<GLsizei>(pyramid_.texels.size() * sizeof(float)),
                         pyramid_.texels.data());
    pyramid_.build();
    view_.hiZLevels = static_cast<int>(pyramid_.levels.size());
}

bool CpuCull::isHidden(glm::vec3 low, glm::vec3 high) const {
    const shared::Footprint print = footprintOfBox(view_, low, high);
    return print.isBefore != 0 && print.nearest < pyramid_.farthestIn(hiZAreaOfBox(view_, print));
}

void CpuCull::run(CullPhase phase, const CullInput& input, const MeshSectionTable& meshSections,
                  const DrawLimits& limits) {
    TERRANE_ZONE("cull on the CPU");
    input_ = &input;
    view_ = input.view();
    arenaQuads_ = meshSections.arenaQuads();
    lists_.resize(meshSections.maxCommands().size());
    for (ArenaLists& lists : lists_)
        for (std::vector<shared::DrawCommand>& list : lists) list.clear();
    records_.clear();
    listed_.clear();
    maxListed_ = limits.listedQuads;
    visibleLastFrame_.resize(meshSections.slots());
    if (phase == CullPhase::Late) {
        readDepth(*input.hiZ, glm::ivec2(input.size));
    } else {
        counts_ = {};
    }
    for (const std::uint32_t slot : meshSections.order()) {
        const shared::MeshSectionRecord& record = meshSections.slotRecords()[slot];
        const shared::uint level = shared::placeLevel(record.place);
        const glm::vec2 corner =
            shared::chunkCorner(record.chunk, level, {input.cameraChunk.x, input.cameraChunk.y});
        const float columnWidth = shared::columnBlocks(level);
        const glm::vec3 low(corner, shared::lowHeight(record.heights));
        const glm::vec3 high(corner + float{shared::kChunkSize} * columnWidth,
                             shared::highHeight(record.heights));
        const glm::vec3 wavingLow = low - shared::kWaving, wavingHigh = high + shared::kWaving;
        if (std::ranges::any_of(input.camera, [&](const glm::vec4& plane) {
                return shared::isOutside(plane, wavingLow, wavingHigh);
            }))
            continue;
        const shared::uint directions = shared::facingDirections(input.cameraPosition, low, high);
        const std::size_t arena = record.ranges[0].x / arenaQuads_;
        const auto firstQuad = static_cast<std::uint32_t>(arena) * arenaQuads_;
        Section section{record,     arena, firstQuad, {}, glm::vec3(corner, shared::placeBase(record.place)),
                        columnWidth};
        std::uint8_t& seen = visibleLastFrame_[slot];
        if (phase == CullPhase::All) {
            for (shared::uint bucket = 0; bucket < shared::kDrawBuckets; ++bucket)
                drawRanges(section, bucket, directions);
            ++counts_.meshSections;
            continue;
        }
        section.quads = input.quads->quadsOnCpu(arena);
        if (phase == CullPhase::Early) {
            for (shared::uint bucket = 0; bucket < shared::kListedDrawLists; ++bucket)
                drawSeen(section, bucket, directions & seen);
            counts_.meshSections += (directions & seen) != 0;
            continue;
        }
        const shared::uint drawnEarly = directions & std::exchange(seen, std::uint8_t{0});
        if (isHidden(wavingLow, wavingHigh)) continue;
        const std::size_t before = records_.size();
        seen = drawNew(section, directions, drawnEarly);
        counts_.meshSections += records_.size() > before;
        for (shared::uint bucket = shared::kListedDrawLists; bucket < shared::kDrawBuckets; ++bucket)
            drawRanges(section, bucket, directions);
    }
    upload();
    input_ = nullptr;
}

void CpuCull::addCommands(const Section& section, shared::uint bucket, std::uint32_t first,
                          std::uint32_t count) {
    counts_.quads[bucket] += count;
    while (count > 0) {
        const std::uint32_t part = std::min(count, shared::kMaxQuadsPerCommand);
        const auto number = static_cast<std::uint32_t>(records_.size());
        lists_[section.arena][bucket].push_back({6 * part, 1, 0, 0, number});
        records_.push_back({section.record.chunk, section.record.place, first});
        ++counts_.commands[bucket];
        first += part;
        count -= part;
    }
}

// All quads, adjacent ranges together.
void CpuCull::drawRanges(const Section& section, shared::uint bucket, shared::uint directions) {
    glm::uvec2 pending(0);
    forEachRange(section.record, bucket, directions, [&](glm::uvec2 range, shared::uint) {
        if (pending.x + pending.y == range.x) {
            pending.y += range.y;
            return;
        }
        addCommands(section, bucket, pending.x - section.firstQuad, pending.y);
        pending = range;
    });
    addCommands(section, bucket, pending.x - section.firstQuad, pending.y);
}

// The quads that were listed from number `first` on; without room for them, all quads of the directions.
void CpuCull::drawListed(const Section& section, shared::uint bucket, std::size_t first,
                         shared::uint directions) {
    if (listed_.size() > maxListed_) {
        listed_.resize(first);
        drawRanges(section, bucket, directions);
        return;
    }
    addCommands(section, bucket, shared::kFirstListedQuad + static_cast<std::uint32_t>(first),
                static_cast<std::uint32_t>(listed_.size() - first));
}

// Room in the list for some quads more.
std::uint32_t* CpuCull::listRoom(std::uint32_t count) {
    listedEnd_ = listed_.size();
    listed_.resize(listedEnd_ + count + kQuadLanes);
    return listed_.data() + listedEnd_;
}

void CpuCull::drawSeen(const Section& section, shared::uint bucket, shared::uint directions) {
    const std::size_t first = listed_.size();
    forEachRange(section.record, bucket, directions, [&](glm::uvec2 range, shared::uint) {
        std::uint32_t* const to = listRoom(range.y);
        listed_.resize(listedEnd_ + listSeen(section.quads, range.x - section.firstQuad, range.y, to));
    });
    drawListed(section, bucket, first, directions);
}

// Sets both bits of all quads that face the camera, and draws the new ones. Returns the directions of quads
// that are seen.
std::uint8_t CpuCull::drawNew(const Section& section, shared::uint directions, shared::uint drawnEarly) {
    const QuadTables& tables = input_->resources->tables();
    QuadTest test{.view = view_,
                  .pyramid = &pyramid_,
                  .shapeFaces = tables.shapeFaces,
                  .isWaving = tables.isWaving,
                  .slabCorner = section.slabCorner,
                  .columnWidth = section.columnWidth};
    shared::uint seenDirections = 0;
    for (shared::uint bucket = 0; bucket < shared::kListedDrawLists; ++bucket) {
        const std::size_t first = listed_.size();
        test.isTwoSided = mesh::bucketTwoSided(static_cast<int>(bucket));
        shared::uint newDirections = 0;
        forEachRange(section.record, bucket, directions, [&](glm::uvec2 range, shared::uint direction) {
            const shared::uint bit = 1u << direction;
            std::uint32_t* const to = listRoom(range.y);
            const QuadTestResult result = testQuads(test, section.quads, range.x - section.firstQuad, range.y,
                                                    (drawnEarly & bit) != 0, to);
            listed_.resize(listedEnd_ + result.newQuads);
            if (result.isAnySeen) seenDirections |= bit;
            if (result.newQuads > 0) newDirections |= bit;
        });
        drawListed(section, bucket, first, newDirections);
    }
    return static_cast<std::uint8_t>(seenDirections);
}

// Replaces the ring where the frame has no more room. Draws of this frame so far keep the old one.
gpu::MappedRing::Allocation CpuCull::allocate(std::size_t bytes) {
    if (!isInFrame_ && ring_.isMapped()) ring_.beginFrame();
    auto allocation = ring_.isMapped() ? ring_.allocate(bytes) : std::nullopt;
    if (!allocation) {
        ring_ = gpu::MappedRing(std::max({kFirstSliceBytes, bytes, 2 * ring_.frameSliceBytes()}), "draws");
        base::require(ring_.isMapped(), "the graphics driver has no memory for draws");
        ringTexels_ = gpu::BufferTexture(ring_.buffer(), GL_R32UI, "draws");
        ring_.beginFrame();
        allocation = ring_.allocate(bytes);
    }
    isInFrame_ = true;
    return *allocation;
}

// Moves the numbers of records and lists to their places in the ring.
void CpuCull::upload() {
    // Both in one piece, so that they are in the same ring.
    const std::size_t recordBytes = records_.size() * sizeof(shared::DrawRecord);
    const auto both = allocate(recordBytes + listed_.size() * sizeof(shared::uint));
    firstRecord_ = both.offsetBytes / sizeof(shared::DrawRecord);
    const auto firstListed =
        static_cast<shared::uint>((both.offsetBytes + recordBytes) / sizeof(shared::uint));
    for (ArenaLists& lists : lists_) {
        for (std::vector<shared::DrawCommand>& list : lists) {
            for (shared::DrawCommand& command : list)
                command.baseInstance += static_cast<shared::uint>(firstRecord_);
        }
    }
    for (shared::DrawRecord& record : records_)
        if (record.firstQuad >= shared::kFirstListedQuad) record.firstQuad += firstListed;
    const auto end = std::ranges::copy(std::as_bytes(std::span(records_)), both.data.begin()).out;
    std::ranges::copy(std::as_bytes(std::span(listed_)), end);
}

void CpuCull::endFrame() {
    if (std::exchange(isInFrame_, false)) ring_.endFrame();
}

}  // namespace terrane::render
