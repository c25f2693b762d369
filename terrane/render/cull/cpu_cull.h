// Selects the draws on the CPU, by the rules of culling.h: where compute shaders run on the CPU too, their
// dispatches and their memory traffic cost more than the work, and drivers that draw lists wrongly need the
// commands here anyway. The selection is that of the compute shaders. The renderer uses it on the context's
// thread.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "terrane/gpu/buffer.h"
#include "terrane/gpu/mapped_ring.h"
#include "terrane/render/cull/cull_input.h"
#include "terrane/render/cull/quad_kernels.h"
#include "terrane/render/quads/mesh_section_table.h"

namespace terrane::render {

class CpuCull {
  public:
    // Call this after all mesh sections were removed: new ones count as not visible in the last frame.
    void invalidate() { visibleLastFrame_.clear(); }
    void run(CullPhase phase, const CullInput& input, const MeshSectionTable& meshSections,
             const DrawLimits& limits);
    // Ends the frame, after its last draw.
    void endFrame();

    // Returns the commands of the last run.
    std::size_t arenaCount() const { return lists_.size(); }
    std::span<const shared::DrawCommand> commands(std::size_t arena, shared::uint list) const {
        return lists_[arena][list];
    }
    // Returns the record of a command of the last run, for tests.
    shared::DrawRecord recordOf(const shared::DrawCommand& command) const {
        return records_[command.baseInstance - firstRecord_];
    }
    const gpu::Buffer& drawRecords() const { return ring_.buffer(); }  // shared::DrawRecord by command
    // Binds the lists of quads for quad.vert.glsl.
    void bindListed() const { ringTexels_.bind(shared::kListedQuadsUnit); }
    // Returns the counts of the frame, summed over its passes so far.
    const shared::DrawCounts& counts() const { return counts_; }
    std::size_t gpuBytes() const { return ring_.buffer().sizeBytes(); }

  private:
    using ArenaLists = std::array<std::vector<shared::DrawCommand>, shared::kDrawLists>;
    struct Section;

    void addCommands(const Section& section, shared::uint bucket, std::uint32_t first, std::uint32_t count);
    void drawRanges(const Section& section, shared::uint bucket, shared::uint directions);
    void drawListed(const Section& section, shared::uint bucket, std::size_t first, shared::uint directions);
    void drawSeen(const Section& section, shared::uint bucket, shared::uint directions);
    std::uint8_t drawNew(const Section& section, shared::uint directions, shared::uint drawnEarly);
    std::uint32_t* listRoom(std::uint32_t count);
    void readDepth(const gpu::Texture2D& hiZ, glm::ivec2 pixels);
    bool isHidden(glm::vec3 low, glm::vec3 high) const;
    gpu::MappedRing::Allocation allocate(std::size_t bytes);
    void upload();

    const CullInput* input_ = nullptr;  // during run()
    shared::CullView view_{};
    shared::uint arenaQuads_ = 0;
    std::size_t maxListed_ = 0;
    DepthPyramid pyramid_;
    std::vector<std::uint8_t> visibleLastFrame_;  // by slot: directions with quads that were not hidden
    std::vector<ArenaLists> lists_;               // by arena
    std::vector<shared::DrawRecord> records_;
    std::vector<shared::uint> listed_;  // numbers of quads in their arenas
    std::size_t listedEnd_ = 0;         // before the room that listRoom() makes
    std::size_t firstRecord_ = 0;       // in the ring
    shared::DrawCounts counts_{};
    gpu::MappedRing ring_;
    gpu::BufferTexture ringTexels_;
    bool isInFrame_ = false;
};

}  // namespace terrane::render
