#include "terrane/view/world_view.h"

#include <chrono>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"
#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/view/gpu_back_ends.h"

namespace terrane::view {
namespace {

using Clock = std::chrono::steady_clock;

// Most batches of the mesher on the GPU take less.
constexpr std::size_t kStagingBytes = std::size_t{8} << 20;

// Horizontal view direction in sixteenths of a circle: chunks are sorted again only when it changes.
glm::vec2 lookSector(const render::Camera& camera) {
    const glm::vec3 look = render::lookDirection(camera);
    const double sector = std::numbers::pi / 8;
    const double angle = std::round(std::atan2(double{look.y}, double{look.x}) / sector) * sector;
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

}  // namespace

void WorldView::follow(const render::Camera& camera, int viewDistance) {
    setCameraHeight(camera);
    setView(render::cameraChunk(camera), viewDistance, lookSector(camera));
    session_.pipeline().update();
    far_.update();
}

void WorldView::setCameraHeight(const render::Camera& camera) {
    session_.pipeline().setCameraHeight(
        static_cast<int>(std::floor(std::clamp(camera.position.z, -1e6, 1e6))));
}

void WorldView::setView(world::ChunkPos center, int viewDistance, glm::vec2 direction) {
    if (viewDistance != requestedDistance_) {
        requestedDistance_ = viewDistance_ = viewDistance;
        horizon_ = requestedHorizon_;
        hasNoticed_ = false;
    }
    center_ = center;
    direction_ = direction;
    moveView();
}

void WorldView::moveView() {
    session_.pipeline().setView(center_, viewDistance_, direction_, horizon_.distance);
    far_.setView(center_, viewDistance_, horizon_);
}

void WorldView::setHorizon(const Horizon& horizon) {
    if (horizon == requestedHorizon_) return;
    requestedHorizon_ = horizon_ = horizon;
    if (horizon.distance > 0) session_.buildTiles();
}

base::Result<void> WorldView::meshOnGpu(const gpu::ShaderLoader& shaders, double budgetMilliseconds) {
    auto mesher = TERRANE_TRY(mesh_gpu::GpuMesher::create(shaders, session_.blocks()));
    queue_.emplace(std::move(mesher), budgetMilliseconds);
    return {};
}

std::size_t WorldView::upload(double budgetSeconds) {
    TERRANE_ZONE("upload chunks");
    const auto start = Clock::now();
    std::size_t count = 0;
    keepWithinBudget();
    updateShownParts();
    do {
        const std::vector<stream::ChunkChange> changes = session_.pipeline().takeChanges(1);
        if (changes.empty()) break;
        show(changes.front());
        ++count;
    } while (std::chrono::duration<double>(Clock::now() - start).count() < budgetSeconds);
    if (queue_) advanceQueue();
    const std::chrono::duration<double> budget(std::min(budgetSeconds, 1e6));
    const auto deadline = start + std::chrono::duration_cast<Clock::duration>(budget);
    while (!far_.upload(deadline) && shortenHorizon()) {
    }
    far_.applyChanges();
    const bool hasNoLimit = std::isinf(budgetSeconds);
    const double reach = double{world::kChunkSize} * visibleDistance();
    tints_.update(center_, reach, hasNoLimit ? TintView::kAllTiles : TintView::kTilesPerFrame);
    land_.update(center_, reach, hasNoLimit ? LandView::kAllTiles : LandView::kTilesPerFrame);
    noticeShortView();
    return count;
}

// Calls set() until it succeeds, and shortens the view in between. False if the chunk is no longer in the
// view.
template <class Set>
bool WorldView::makeRoomFor(world::ChunkPos pos, const Set& set) {
    while (!set()) {
        if (!shortenView()) {
            warnOfNoRoom(pos);
            return true;
        }
        if (session_.pipeline().stageAt(pos) != stream::ChunkStage::Visible) return false;
    }
    return true;
}

// Halves the horizon; false if there is no far land. The horizon is shortened before the view.
bool WorldView::shortenHorizon() {
    if (horizon_.distance <= viewDistance_) return false;
    horizon_.distance /= 2;
    moveView();
    far_.applyNow();
    return true;
}

// Shortens the horizon or the view; false if both are as short as possible.
bool WorldView::shortenView() {
    if (shortenHorizon()) return true;
    const render::GpuMemory used = renderer_.memory();
    const std::size_t budget = renderer_.memoryBudget();
    const std::size_t limitBytes = budget - std::min(budget, used.fixed());
    const int shorter =
        fittingViewDistance({renderer_.chunkCount(), used.world(), limitBytes}, viewDistance_);
    if (shorter >= viewDistance_) return false;
    viewDistance_ = shorter;
    moveView();
    for (const world::ChunkPos pos : session_.pipeline().takeHidden()) hide(pos);
    return true;
}

// The image may get larger, or the mesher take more, when the world already uses the whole budget. Buffers do
// not shrink, so all chunks are removed, and those that fit are added again. Once for each size of the fixed
// memory.
void WorldView::keepWithinBudget() {
    if (queue_) renderer_.setStagingBytes(std::max(queue_->gpuBytes(), kStagingBytes));
    const render::GpuMemory used = renderer_.memory();
    const std::size_t budget = renderer_.memoryBudget();
    if (used.total() <= budget || used.fixed() <= fixedBytes_) return;
    fixedBytes_ = used.fixed();
    showAgain();
}

// What the renderer did not have before comes again.
void WorldView::updateShownParts() {
    if (shown_ == shownParts()) return;
    shown_ = shownParts();
    session_.pipeline().setMeshing(shown_.quads && !queue_ ? stream::MeshPolicy::Workers
                                                           : stream::MeshPolicy::Caller);
    showAgain();
}

void WorldView::showAgain() {
    session_.pipeline().hideAll();
    for (const world::ChunkPos pos : session_.pipeline().takeHidden()) hide(pos);
    renderer_.clearChunks();
    far_.invalidateAll();
}

void WorldView::noticeShortView() {
    const stream::ChunkPipeline& pipeline = session_.pipeline();
    const bool isShort = viewDistance_ < requestedDistance_ && !hasNoticed_;
    if (!isShort || !pipeline.progress().complete() || pipeline.waitingChanges() + waiting() > 0) return;
    hasNoticed_ = true;
    notice_ = shortViewNotice(requestedDistance_, viewDistance_, renderer_.memoryBudget());
    base::logWarning("{}", *notice_);
}

void WorldView::show(const stream::ChunkChange& change) {
    if (change.isHidden) return hide(change.pos);
    far_.prepareChunk(change.pos);
    const auto setLight = [&] { return renderer_.setLight(change.pos, *change.light, change.bricks); };
    if (change.light && !makeRoomFor(change.pos, setLight)) return;
    const auto setBlocks = [&] {
        return renderer_.setBlocks(change.pos, session_.pipeline().meshBlocks(change.pos)[0]);
    };
    const bool hasBlocks = shown_.blocks && (change.mesh || change.needsMesh);
    if (hasBlocks && !makeRoomFor(change.pos, setBlocks)) return;
    if (!shown_.quads) {
        if (hasBlocks) far_.setChunkReady(change.pos, true);
        return;
    }
    // An edited chunk that is queued or in flight is meshed again as a whole.
    if (change.needsMesh || (change.mesh && queue_ && queue_->contains(change.pos))) {
        queue_->add(change.pos);
    } else if (change.mesh) {
        const auto setMesh = [&] {
            return renderer_.setChunk(change.pos, *change.mesh, change.meshSections);
        };
        if (makeRoomFor(change.pos, setMesh)) far_.setChunkReady(change.pos, true);
    }
}

void WorldView::hide(world::ChunkPos pos) {
    if (queue_) queue_->remove(pos);
    far_.setChunkReady(pos, false);
    renderer_.removeChunk(pos);
}

void WorldView::advanceQueue() {
    if (queue_->isCounted()) writeMeshes();
    countMeshes();
}

void WorldView::writeMeshes() {
    std::vector<mesh_gpu::FirstQuads> places;
    std::vector<world::ChunkPos> refused;
    for (const mesh_gpu::CountedChunk& chunk : queue_->takeCounted()) {
        mesh_gpu::FirstQuads& firstQuads = places.emplace_back();
        if (!renderer_.reserveChunk(chunk.pos, chunk.meshSections)) {
            refused.push_back(chunk.pos);
            continue;
        }
        far_.setChunkReady(chunk.pos, true);
        for (const mesh::MeshSection& section : renderer_.meshSectionsOf(chunk.pos)) {
            firstQuads.push_back(mesh::firstQuad(section));
        }
    }
    queue_->write(places, renderer_.quadBuffers());
    if (refused.empty()) return;
    if (!shortenView()) return warnOfNoRoom(refused.front());
    // Refused chunks that are still in view come with the next batch.
    for (const world::ChunkPos pos : refused) {
        if (session_.pipeline().stageAt(pos) == stream::ChunkStage::Visible) queue_->add(pos);
    }
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

// Warns once: there may be thousands of chunks.
void WorldView::warnOfNoRoom(world::ChunkPos pos) {
    if (hasWarned_) return;
    hasWarned_ = true;
    base::logWarning(
        "no room within {} MiB of GPU memory even for a view distance of {}: chunk {},{} and others after it "
        "are "
        "not shown whole",
        renderer_.memoryBudget() >> 20, viewDistance_, pos.x, pos.y);
}

void WorldView::waitForWorkers(std::chrono::milliseconds timeout) {
    const bool hasChunks = session_.pipeline().progress().isUpToDate();
    if (hasChunks && missingTiles() == 0 && missingClipmapTiles() > 0) {
        tints_.missing() > 0 ? tints_.wait(timeout) : land_.wait(timeout);
    } else if (hasChunks) {
        session_.tiles().waitForWorkers(timeout);
    } else {
        session_.pipeline().waitForWorkers(timeout);
    }
}

double loadAll(game::Session& session, WorldView& view, const render::Camera& camera, int viewDistance,
               stream::ChunkPipeline::Time now) {
    stream::ChunkPipeline& pipeline = session.pipeline();
    view.setCameraHeight(camera);
    view.setView(render::cameraChunk(camera), viewDistance);
    double uploads = 0;
    for (;;) {
        pipeline.update(now);
        view.updateTiles();
        const auto start = Clock::now();
        const std::size_t changed = view.upload(std::numeric_limits<double>::infinity());
        uploads += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        const bool isLoaded =
            pipeline.progress().isUpToDate() && view.missingTiles() + view.missingClipmapTiles() == 0;
        if (isLoaded && changed == 0 && view.waiting() == 0) return uploads;
        if (!isLoaded && changed == 0) view.waitForWorkers(std::chrono::milliseconds(100));
    }
}

}  // namespace terrane::view
