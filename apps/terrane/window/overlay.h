// What is drawn over the image: crosshair, what is looked at, statistics, hints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/window/text.h"
#include "terrane/game/block_interaction.h"
#include "terrane/gpu/timer.h"
#include "terrane/render/renderer.h"
#include "terrane/render/shadow_volume.h"
#include "terrane/stream/chunk_pipeline.h"
#include "terrane/view/frame_meter.h"
#include "terrane/world/ray_cast.h"

namespace terrane::app {

struct Screen {
    float width = 0, height = 0;  // in Dear ImGui's units
};

struct TargetView {
    const world::World& world;
    const world::BlockRegistry& blocks;
    bool isHighContrast = false;  // in black, white and orange, which color-blind eyes tell apart
};
// The edges of the block that is looked at, of its faces that nothing covers, and the face under the
// crosshair.
void drawTarget(const Screen& screen, const render::Camera& camera, const world::RayHit& target,
                const TargetView& view);
// Straight over a camera, so high that all within the view distance (chunks) is seen.
render::Camera debugTopCamera(const render::Camera& camera, int viewDistance);
// What the camera sees, up to `farBlocks`, and what its nearest shadow map covers, if there is a light that
// casts shadows, as seen from above.
void drawDebugTopView(const Screen& screen, const render::Camera& above, const render::Camera& camera,
                      float farBlocks, const std::optional<glm::vec3>& shadowLight);
void drawCrosshair(const Screen& screen);

// Bytes by owner. Finding them goes through all chunks.
struct MemoryStatistics {
    std::size_t blocks = 0, light = 0, quads = 0, lightOnGpu = 0;
    std::size_t onGpu = 0, gpuBudget = 0;  // all, with what is free in buffers
    std::size_t resident = 0;              // of the process; 0 where the system does not tell
};

struct Statistics {
    const view::FrameMeter* frames = nullptr;
    render::Camera camera;
    double timeDay = 0;
    stream::Progress progress;
    const stream::TileTable* tiles = nullptr;
    std::size_t activeChunks = 0, queuedChunks = 0;
    render::FrameStatistics frame;
    MemoryStatistics memory;
    std::vector<stream::TaskTime> tasks;
    const std::vector<gpu::GpuTiming>* passes = nullptr;
};
// `width`: of the column at the left in which they are written.
void drawStatistics(const Statistics& statistics, float width);

// While chunks in view are missing.
void drawProgress(const Screen& screen, const stream::Progress& progress, const Texts& tr);
// The keys, for the first moments. `share`: 1 in full, 0 gone.
void drawHint(const Screen& screen, float share, const Texts& tr);
// A line that tells what just happened.
void drawMessage(const Screen& screen, const std::string& message, float share);

}  // namespace terrane::app
