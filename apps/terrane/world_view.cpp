#include "apps/terrane/world_view.h"

#include <chrono>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"

namespace terrane::app {
namespace {

using Clock = std::chrono::steady_clock;

// Where the camera looks over the ground, in sixteenths of a circle: chunks are put in order again only when
// it turns.
glm::vec2 lookSector(const render::Camera& camera) {
    const glm::vec3 look = render::lookDirection(camera);
    const double sector = std::numbers::pi / 8;
    const double angle = std::round(std::atan2(double{look.y}, double{look.x}) / sector) * sector;
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

}  // namespace

void WorldView::follow(const render::Camera& camera, int viewDistance) {
    session_.pipeline->setView(render::cameraChunk(camera), viewDistance, lookSector(camera));
    session_.pipeline->update();
}

std::size_t WorldView::upload(double budgetSeconds) {
    TERRANE_ZONE("upload chunks");
    const auto start = Clock::now();
    std::size_t count = 0;
    for (;;) {
        const std::vector<stream::ChunkChange> changes = session_.pipeline->takeChanges(1);
        if (changes.empty()) return count;
        show(changes.front());
        ++count;
        if (std::chrono::duration<double>(Clock::now() - start).count() >= budgetSeconds) return count;
    }
}

void WorldView::show(const stream::ChunkChange& change) {
    if (change.isHidden) return renderer_.removeChunk(change.pos);
    if (change.mesh && !renderer_.setChunk(change.pos, *change.mesh, change.regions) && !hasWarned_) {
        base::logWarning(
            "no room on the graphics card for all quads: chunk {},{} and others after it are not shown "
            "whole; "
            "a shorter --view-distance needs less",
            change.pos.x, change.pos.y);
        hasWarned_ = true;
    }
    if (change.light) renderer_.setLight(change.pos, *change.light, change.bricks);
}

double loadAll(WorldSession& session, render::Renderer& renderer, const render::Camera& camera,
               int viewDistance, stream::ChunkPipeline::Time now) {
    stream::ChunkPipeline& pipeline = *session.pipeline;
    pipeline.setView(render::cameraChunk(camera), viewDistance);
    WorldView view(session, renderer);
    double uploads = 0;
    for (;;) {
        pipeline.update(now);
        const auto start = Clock::now();
        const std::size_t changed = view.upload(std::numeric_limits<double>::infinity());
        uploads += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        // Visible chunks that are meshed anew come a few an update.
        if (pipeline.progress().complete() && changed == 0) return uploads;
        if (changed == 0) pipeline.waitForWorkers(std::chrono::milliseconds(100));
    }
}

}  // namespace terrane::app
