#include "apps/terrane/chunk_uploads.h"

#include "apps/terrane/content.h"
#include "terrane/base/log.h"
#include "terrane/gpu/device_info.h"
#include "terrane/mesh/region_quads.h"

namespace terrane::app {
namespace {

void warnOfNoRoom(world::ChunkPos pos) {
    base::logWarning("chunk {},{}: no room for its quads on the graphics card, not all of it is shown", pos.x,
                     pos.y);
}

}  // namespace

base::Result<ChunkUploads> ChunkUploads::create(Backend backend, double budgetMilliseconds,
                                                const world::BlockRegistry& blocks,
                                                stream::ChunkPipeline& pipeline, render::Renderer& renderer) {
    ChunkUploads uploads(pipeline, renderer);
    if (!usesGpu(backend)) return uploads;
    auto mesher = mesh_gpu::GpuMesher::create(makeShaderLoader(""), blocks);
    if (!mesher) return tl::unexpected(mesher.error());
    uploads.queue_.emplace(std::move(*mesher), blocks, budgetMilliseconds);
    pipeline.leaveMeshesOut();
    return uploads;
}

void ChunkUploads::update(std::size_t limit) {
    for (const stream::ChunkChange& change : pipeline_->takeChanges(limit)) apply(change);
    if (queue_) advanceQueue();
}

void ChunkUploads::apply(const stream::ChunkChange& change) {
    if (change.isHidden) {
        if (queue_) queue_->remove(change.pos);
        renderer_->removeChunk(change.pos);
        return;
    }
    if (change.light) renderer_->setLight(change.pos, *change.light, change.bricks);
    // An edit of a chunk that is on the way is meshed with the rest of it.
    if (change.needsMesh || (change.mesh && queue_ && queue_->contains(change.pos))) {
        queue_->add(change.pos);
    } else if (change.mesh && !renderer_->setChunk(change.pos, *change.mesh, change.regions)) {
        warnOfNoRoom(change.pos);
    }
}

void ChunkUploads::advanceQueue() {
    const auto place = [&](world::ChunkPos pos, std::span<const mesh::RegionMesh> regions) {
        std::vector<std::uint32_t> firstQuads;
        if (!renderer_->reserveChunk(pos, regions)) {
            warnOfNoRoom(pos);
            return firstQuads;
        }
        for (const mesh::RegionMesh& region : renderer_->regionsOf(pos)) {
            firstQuads.push_back(mesh::firstQuad(region));
        }
        return firstQuads;
    };
    queue_->advance(pipeline_->meshOptions(),
                    {[&](world::ChunkPos pos) { return pipeline_->meshBlocks(pos); }, place,
                     [&]() -> const gpu::Buffer& { return renderer_->quadBuffer(); }});
}

}  // namespace terrane::app
