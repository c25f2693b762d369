#include "terrane/view/world_view.h"

#include <chrono>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"
#include "terrane/mesh/mesh_section_quads.h"

namespace terrane::view {
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
    session_.pipeline().setView(render::cameraChunk(camera), viewDistance, lookSector(camera));
    session_.pipeline().update();
}

base::Result<void> WorldView::meshOnGpu(const gpu::ShaderLoader& shaders, double budgetMilliseconds) {
    auto mesher = mesh_gpu::GpuMesher::create(shaders, session_.blocks());
    if (!mesher) return tl::unexpected(mesher.error());
    queue_.emplace(std::move(*mesher), budgetMilliseconds);
    return {};
}

std::size_t WorldView::upload(double budgetSeconds) {
    TERRANE_ZONE("upload chunks");
    const auto start = Clock::now();
    std::size_t count = 0;
    do {
        const std::vector<stream::ChunkChange> changes = session_.pipeline().takeChanges(1);
        if (changes.empty()) break;
        show(changes.front());
        ++count;
    } while (std::chrono::duration<double>(Clock::now() - start).count() < budgetSeconds);
    if (queue_) advanceQueue();
    return count;
}

void WorldView::show(const stream::ChunkChange& change) {
    if (change.isHidden) return hide(change.pos);
    if (change.light) renderer_.setLight(change.pos, *change.light, change.bricks);
    // An edit of a chunk that is on the way is meshed with the rest of it.
    if (change.needsMesh || (change.mesh && queue_ && queue_->contains(change.pos))) {
        queue_->add(change.pos);
    } else if (change.mesh && !renderer_.setChunk(change.pos, *change.mesh, change.meshSections)) {
        warnOfNoRoom(change.pos);
    }
}

void WorldView::hide(world::ChunkPos pos) {
    if (queue_) queue_->remove(pos);
    renderer_.removeChunk(pos);
}

void WorldView::advanceQueue() {
    if (queue_->isCounted()) writeMeshes();
    countMeshes();
}

void WorldView::writeMeshes() {
    std::vector<mesh_gpu::FirstQuads> places;
    for (const mesh_gpu::CountedChunk& chunk : queue_->takeCounted()) {
        mesh_gpu::FirstQuads& firstQuads = places.emplace_back();
        if (!renderer_.reserveChunk(chunk.pos, chunk.meshSections)) {
            warnOfNoRoom(chunk.pos);
            continue;
        }
        for (const mesh::MeshSection& section : renderer_.meshSectionsOf(chunk.pos)) {
            firstQuads.push_back(mesh::firstQuad(section));
        }
    }
    queue_->write(places, renderer_.quadBuffer());
}

void WorldView::countMeshes() {
    const stream::ChunkPipeline& pipeline = session_.pipeline();
    std::vector<mesh::MeshBlocks> blocks;
    for (const world::ChunkPos pos : queue_->takeWaiting()) blocks.push_back(pipeline.meshBlocks(pos));
    if (blocks.empty()) return;
    std::vector<mesh::MeshInput> inputs;
    for (const mesh::MeshBlocks& chunk : blocks) {
        inputs.push_back(mesh::meshInput(chunk, session_.blocks(), pipeline.meshOptions()));
    }
    queue_->count(inputs);
}

// Once: there may be thousands.
void WorldView::warnOfNoRoom(world::ChunkPos pos) {
    if (hasWarned_) return;
    hasWarned_ = true;
    base::logWarning(
        "no room on the graphics card for all quads: chunk {},{} and others after it are not shown whole; a "
        "shorter --view-distance needs less",
        pos.x, pos.y);
}

double loadAll(game::Session& session, WorldView& view, const render::Camera& camera, int viewDistance,
               stream::ChunkPipeline::Time now) {
    stream::ChunkPipeline& pipeline = session.pipeline();
    pipeline.setView(render::cameraChunk(camera), viewDistance);
    double uploads = 0;
    for (;;) {
        pipeline.update(now);
        const auto start = Clock::now();
        const std::size_t changed = view.upload(std::numeric_limits<double>::infinity());
        uploads += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        const bool isLoaded = pipeline.progress().isUpToDate();
        if (isLoaded && changed == 0 && view.waiting() == 0) return uploads;
        if (!isLoaded && changed == 0) pipeline.waitForWorkers(std::chrono::milliseconds(100));
    }
}

}  // namespace terrane::view
