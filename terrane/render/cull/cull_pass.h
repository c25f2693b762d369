// Selects the draws: mesh sections in view, without face directions that face away from the camera, become
// draw commands, nearest first; with occlusion culling the commands draw lists of quads. Compute shaders
// select them for indirect draws (quad_list.h), or the CPU does (cpu_cull.h). The renderer uses it on the
// context's thread.
#pragma once

#include <array>

#include "terrane/gpu/context.h"
#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/pipeline_state.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/readback_buffer.h"
#include "terrane/render/cull/cpu_cull.h"
#include "terrane/render/cull/cull_input.h"
#include "terrane/render/cull/quad_list.h"
#include "terrane/render/quads/mesh_section_table.h"

namespace terrane::render {

// Finds the visible quads on the GPU: those in view that cover a sample and are not hidden by the depth of
// the early pass. Most quads of mesh sections in view are hidden: in a landscape four in five.
//
// Two bits of a quad (shared/quad.h) hold the result for quad_list.h: *seen* quads are drawn by the early
// pass of the next frame, *new* ones are added by the late pass of this frame. A new quad of the mesher has
// neither, so it is tested before it is drawn. As with mesh sections, no visible quad is missing in any
// frame. The renderer uses it on the context's thread.
class QuadCull {
  public:
    static base::Result<QuadCull> create(const gpu::ShaderLoader& shaders);

    // Makes room for this many mesh sections and clears the list of those to test, for cull.comp.glsl.
    void begin(std::uint32_t meshSections);
    // Tests the quads of the mesh sections in the list, with the inputs of cull.comp.glsl bound. Later draws
    // see the bits.
    void run(const QuadStore& quads, const QuadResources& resources) const;
    std::size_t gpuBytes() const { return list_.sizeBytes(); }

  private:
    gpu::Program program_;
    gpu::Buffer list_;  // shared::TestedMeshSections, then their numbers
};

class CullPass {
  public:
    static base::Result<CullPass> create(const gpu::ShaderLoader& shaders, const gpu::DeviceInfo& device,
                                         const DrawLimits& limits = {});

    // Call this after all mesh sections were removed: new ones count as not visible in the last frame.
    void invalidate() {
        visibleLastFrame_ = {};
        cpu_.invalidate();
    }
    // Runs a pass. `meshSections` is up to date. The early and the late pass of a frame follow each other,
    // with drawing between them.
    void run(CullPhase phase, const CullInput& input, const MeshSectionTable& meshSections,
             gpu::MappedRing& ring);
    // Draws the quads that the last pass selected, one draw call for each draw bucket and arena of `quads`,
    // or with DrawMethod::Loop for each command. The shader and its other inputs are bound, also the records
    // of draws. Culls the back faces of one-sided quads.
    void drawBuckets(gpu::Pipeline& pipeline, const gpu::PipelineState& state, const QuadStore& quads,
                     mesh::AlphaClass alphaClass) const;

    const DrawLimits& limits() const { return limits_; }
    const gpu::Buffer& drawRecords() const {  // shared::DrawRecord by command
        return method_ == DrawMethod::Loop ? cpu_.drawRecords() : records_;
    }

    // Ends the frame. Its counts follow, those of the GPU some frames later.
    void endFrame();
    // Counts of the newest finished frame, summed over its passes; does not wait.
    const shared::DrawCounts& counts();

    struct Draw {
        shared::DrawCommand command;
        shared::DrawRecord record;
    };
    // Returns the draws of the last run, for tests: waits for the GPU.
    std::vector<Draw> readDraws(shared::uint list, std::size_t arena = 0) const;

    // Returns the GPU memory as of the next run, by this method. Includes buffers that it replaces; QuadCull,
    // QuadList and CpuCull count with their present size.
    std::size_t gpuBytes(const MeshSectionTable& meshSections, DrawMethod method) const;
    std::size_t listBytes() const { return cpu_.gpuBytes(); }  // part of it: the lists of the CPU

  private:
    void reserve(const MeshSectionTable& meshSections);
    void dispatch(const CullInput& input, const MeshSectionTable& meshSections, gpu::MappedRing& ring);
    void drawList(shared::uint list, std::size_t arena) const;
    bool isEmpty(shared::uint list, std::size_t arena) const;
    std::size_t arenaCount() const { return method_ == DrawMethod::Loop ? cpu_.arenaCount() : lists_.size(); }
    std::size_t commandBytes(const MeshSectionTable& meshSections, std::size_t bytesEach) const;
    std::size_t countsOffset(std::size_t arena) const;

    struct Readback {
        gpu::ReadbackBuffer buffer;
        gpu::Fence fence;
        bool isPending = false;
        std::size_t arenas = 0;
    };
    // First command of a list in the buffer, and the most commands.
    struct ListCommands {
        std::uint32_t first = 0, max = 0;
    };
    using ArenaLists = std::array<ListCommands, shared::kDrawLists>;
    static constexpr std::size_t kReadbacks = 4;

    CpuCull cpu_;
    gpu::Program cull_, compact_;
    QuadCull quadCull_;
    QuadList quadList_;
    gpu::Buffer visible_, visibleLastFrame_, commands_, records_, countBuffer_;
    CullPhase phase_ = CullPhase::All;
    DrawMethod method_ = DrawMethod::Indirect;
    DrawLimits limits_;
    std::vector<ArenaLists> lists_;  // by arena
    std::uint32_t commandsEnd_ = 0;  // of the last list
    std::array<Readback, kReadbacks> readbacks_;
    std::size_t nextReadback_ = 0;
    shared::DrawCounts counts_{};
    bool hasIndirectCount_ = false;
};

// The input of a pass that draws quads: the quads that culling selected, and the data that shaders read of
// them. The renderer uses it on the context's thread.
struct QuadDraw {
    QuadResources& resources;
    const QuadStore& quads;
    const CullPass& culled;  // draws the selection of its last run
    bool isSmooth = false;   // textures are filtered

    void bind() const { resources.bind(culled.drawRecords(), isSmooth); }
    // Draws with the shader and the bindings of bind().
    void draw(gpu::Pipeline& pipeline, const gpu::PipelineState& state, mesh::AlphaClass alphaClass) const {
        culled.drawBuckets(pipeline, state, quads, alphaClass);
    }
};

}  // namespace terrane::render
