// Overlays on the image: crosshair, targeted block, statistics, hints.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/terrane/window/settings/key_help.h"
#include "apps/terrane/window/text.h"
#include "terrane/game/block_interaction.h"
#include "terrane/gpu/timer.h"
#include "terrane/render/frame/camera.h"
#include "terrane/render/frame/renderer.h"
#include "terrane/render/shadow/shadow_volume.h"
#include "terrane/stream/chunk_pipeline.h"
#include "terrane/view/frame_times.h"
#include "terrane/world/ray_cast.h"

namespace terrane::app {

// Projects points of the world to the screen, for overlays. Plain value.
class ScreenProjection {
  public:
    // `size` in Dear ImGui's units.
    ScreenProjection(glm::vec2 size, const render::Camera& camera);

    // None behind the camera.
    std::optional<glm::vec2> at(const glm::dvec3& point) const;
    // The part of a line in front of the camera.
    std::optional<std::pair<glm::vec2, glm::vec2>> line(const glm::dvec3& from, const glm::dvec3& to) const;

  private:
    glm::vec4 clip(const glm::dvec3& point) const;
    glm::vec2 onScreen(const glm::vec4& clip) const;

    glm::vec2 size_;
    glm::dvec3 corner_;  // of the camera's chunk
    glm::mat4 viewProjection_;
};

struct Screen {
    float width = 0, height = 0;  // in Dear ImGui's units
};
class OverlayLayout;  // overlay_layout.h

struct TargetView {
    const world::World& world;
    const world::BlockRegistry& blocks;
    bool isHighContrast = false;  // black, white and orange, for color-blind players
};
// Draws the edges of the targeted block's uncovered faces, and the face under the crosshair.
void drawTarget(const Screen& screen, const render::Camera& camera, const world::RayHit& target,
                const TargetView& view);
// A camera straight above, high enough to see everything within the view distance (chunks).
render::Camera debugTopCamera(const render::Camera& camera, int viewDistance);
// Draws the camera's frustum up to `farBlocks` and, with a shadow-casting light, the box of the nearest
// shadow map, as seen from above.
void drawDebugTopView(const Screen& screen, const render::Camera& above, const render::Camera& camera,
                      float farBlocks, const std::optional<glm::vec3>& shadowLight);
void drawCrosshair(OverlayLayout& layout);  // in the middle, if nothing is there

// Bytes by owner. Computing them visits all chunks.
struct MemoryStatistics {
    std::size_t blocks = 0, light = 0, quads = 0, lightOnGpu = 0;
    std::size_t onGpu = 0, gpuBudget = 0;  // total, with free space in buffers
    std::size_t resident = 0;              // of the process; 0 if unknown
};

struct Statistics {
    const view::FrameMeter* frames = nullptr;
    render::Camera camera;
    double timeDay = 0;
    int renderScale = 100;  // percent
    stream::Progress progress;
    const stream::TileTable* tiles = nullptr;
    std::size_t activeChunks = 0, queuedChunks = 0;
    render::FrameStatistics frame;
    MemoryStatistics memory;
    std::vector<stream::TaskTime> tasks;
    const std::vector<gpu::GpuTiming>* passes = nullptr;
};
void drawStatistics(OverlayLayout& layout, const Statistics& statistics);

// Shown while chunks in view are missing.
void drawProgress(OverlayLayout& layout, const stream::Progress& progress, const Texts& tr);
// The list of keys, shown at the start; long lines wrap. `share`: opacity, 0 to 1.
void drawKeyHelp(OverlayLayout& layout, float share, const std::vector<KeyHelpLine>& lines);
// A text about the last event; long ones wrap. `share`: opacity, 0 to 1.
void drawMessage(OverlayLayout& layout, const std::string& message, float share);

}  // namespace terrane::app
