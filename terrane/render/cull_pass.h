// Decides on the GPU what is drawn: regions in the view of the camera and of the shadow map, without the
// groups of faces that look away, become indirect draw commands, nearest first. Used by the renderer on the
// context's thread.
#pragma once

#include <array>
#include <optional>

#include "terrane/gpu/device_info.h"
#include "terrane/gpu/fence.h"
#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/readback_buffer.h"
#include "terrane/render/region_table.h"

namespace terrane::render {

struct CullInput {
    world::ChunkPos cameraChunk;
    glm::vec3 cameraPosition;  // from its corner
    Frustum camera;
    glm::vec3 lightDirection;
    std::optional<Frustum> shadow;  // none: no shadow map
};

class CullPass {
  public:
    static base::Result<CullPass> create(const gpu::ShaderLoader& shaders, const gpu::DeviceInfo& device);

    // `regions` is up to date.
    void run(const CullInput& input, const RegionTable& regions, gpu::MappedRing& ring);
    // The draw call of a list of shared/region.h, with everything else bound.
    void drawList(shared::uint list) const;
    void drawContexts(mesh::AlphaClass alphaClass, bool forShadows) const;

    // Of the newest frame that the GPU has finished; does not wait.
    const shared::DrawCounts& counts();

    // For tests: waits for the GPU.
    std::vector<shared::DrawCommand> readCommands(shared::uint list) const;

  private:
    void reserve(const RegionTable& regions);
    void queueReadback();

    struct Readback {
        gpu::ReadbackBuffer buffer;
        gpu::Fence fence;
        bool isPending = false;
    };
    static constexpr std::size_t kReadbacks = 4;

    gpu::Program cull_, compact_;
    gpu::Buffer visible_, commands_, countBuffer_;
    std::array<std::uint32_t, shared::kDrawLists> firstCommand_{}, mostCommands_{};
    std::array<Readback, kReadbacks> readbacks_;
    std::size_t nextReadback_ = 0;
    shared::DrawCounts counts_{};
    bool hasIndirectCount_ = false;
};

}  // namespace terrane::render
