// A world being generated around a camera: what play and render have in common.
#pragma once

#include <memory>

#include "apps/terrane/options.h"
#include "terrane/base/job_system.h"
#include "terrane/gen/generator.h"
#include "terrane/stream/chunk_pipeline.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::app {

base::Result<gen::Generator> makeGenerator(const WorldOptions& options, const world::BlockRegistry& blocks);

// The parts refer to each other by address: made in place, destroyed in reverse order.
struct WorldSession {
    static base::Result<std::unique_ptr<WorldSession>> create(const WorldOptions& options);
    WorldSession(world::BlockRegistry registry, const WorldOptions& options);

    world::BlockRegistry blocks;
    std::unique_ptr<gen::Generator> generator;
    world::World world;
    base::JobSystem jobs;
    std::unique_ptr<stream::ChunkPipeline> pipeline;
};

// Hands at most `limit` changed chunks to the renderer.
void uploadMeshes(stream::ChunkPipeline& pipeline, render::Renderer& renderer, std::size_t limit);

// Where everything has become sky.
inline float fogDistance(int viewDistance) {
    return static_cast<float>(viewDistance) * static_cast<float>(world::kChunkSize);
}

}  // namespace terrane::app
