// Brings what changed in the world to the renderer, frame by frame: light and meshes as the pipeline's
// workers made them, or, on the GPU back end, meshes that the GPU makes where they are drawn from.
#pragma once

#include <optional>

#include "apps/terrane/backend.h"
#include "terrane/mesh_gpu/mesh_queue.h"
#include "terrane/render/renderer.h"
#include "terrane/stream/chunk_pipeline.h"

namespace terrane::app {

class ChunkUploads {
  public:
    // Time of a frame for meshing on the GPU.
    static constexpr double kFrameMilliseconds = 3;

    // Comes before the pipeline's first update. The pipeline, the renderer and the blocks outlive it.
    static base::Result<ChunkUploads> create(Backend backend, double budgetMilliseconds,
                                             const world::BlockRegistry& blocks,
                                             stream::ChunkPipeline& pipeline, render::Renderer& renderer);

    // Hands at most `limit` changed chunks on; between two frames.
    void update(std::size_t limit);
    // Of those that were handed on all is shown in the next frame.
    bool isIdle() const { return !queue_ || queue_->size() == 0; }
    std::size_t waiting() const { return queue_ ? queue_->size() : 0; }

  private:
    ChunkUploads(stream::ChunkPipeline& pipeline, render::Renderer& renderer)
        : pipeline_(&pipeline), renderer_(&renderer) {}
    void apply(const stream::ChunkChange& change);
    void advanceQueue();

    stream::ChunkPipeline* pipeline_;
    render::Renderer* renderer_;
    std::optional<mesh_gpu::MeshQueue> queue_;
};

}  // namespace terrane::app
