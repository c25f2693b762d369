// Decides on the GPU what is drawn: mesh sections in the view of the camera and of the shadow map, without
// the face directions that look away, become indirect draw commands, nearest first. Used by the renderer on
// the context's thread.
#pragma once

#include <array>
#include <optional>

#include "terrane/gpu/device_info.h"
#include "terrane/gpu/fence.h"
#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/pipeline_state.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/readback_buffer.h"
#include "terrane/render/hi_z.h"
#include "terrane/render/mesh_section_table.h"

namespace terrane::render {

struct CullInput {
    world::ChunkPos cameraChunk;
    glm::vec3 cameraPosition;  // from its corner
    Frustum camera;
    glm::vec3 lightDirection;
    std::optional<Frustum> shadow;  // none: no shadow map
    glm::mat4 viewProjection{1};
    glm::vec2 size{1};         // of the image in pixels
    const HiZ* hiZ = nullptr;  // for the late pass
};

// All in view at once, or in two passes: early, what was visible in the frame before, then late, what its
// depth does not hide.
enum class CullPhase : std::uint8_t { All, Early, Late };

class CullPass {
  public:
    static base::Result<CullPass> create(const gpu::ShaderLoader& shaders, const gpu::DeviceInfo& device);

    // `meshSections` is up to date.
    // The early and the late pass of a frame follow each other, drawing between them.
    void run(CullPhase phase, const CullInput& input, const MeshSectionTable& meshSections,
             gpu::MappedRing& ring);
    // Draws what the last pass chose, with the shader and what it reads bound. Culls the back faces of what
    // has such.
    void drawBuckets(gpu::Pipeline& pipeline, gpu::PipelineState state, mesh::AlphaClass alphaClass,
                     bool forShadows) const;

    // Of the newest frame that the GPU has finished, all runs together; does not wait. Ends the frame.
    void queueCounts();
    const shared::DrawCounts& counts();

    // Of the last run, for tests: waits for the GPU.
    std::vector<shared::DrawCommand> readCommands(shared::uint list) const;

  private:
    void reserve(const MeshSectionTable& meshSections);
    void dispatch(const CullInput& input, const MeshSectionTable& meshSections, gpu::MappedRing& ring);
    void drawList(shared::uint list) const;
    std::size_t countsOffset() const { return phase_ == CullPhase::Late ? sizeof(shared::DrawCounts) : 0; }

    struct Readback {
        gpu::ReadbackBuffer buffer;
        gpu::Fence fence;
        bool isPending = false;
    };
    static constexpr std::size_t kReadbacks = 4;

    gpu::Program cull_, compact_;
    gpu::Buffer visible_, visibleLastFrame_, commands_, countBuffer_;
    CullPhase phase_ = CullPhase::All;
    std::array<std::uint32_t, shared::kDrawLists> firstCommand_{}, maxCommands_{};
    std::array<Readback, kReadbacks> readbacks_;
    std::size_t nextReadback_ = 0;
    shared::DrawCounts counts_{};
    bool hasIndirectCount_ = false;
};

}  // namespace terrane::render
