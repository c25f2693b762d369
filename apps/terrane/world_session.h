// A world around a camera, from its save or its generator: what play and render have in common.
#pragma once

#include <memory>

#include "apps/terrane/option_values.h"
#include "terrane/base/job_system.h"
#include "terrane/gen/generator.h"
#include "terrane/light/light_table.h"
#include "terrane/store/open_world.h"
#include "terrane/stream/chunk_pipeline.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::app {

base::Result<gen::Generator> makeGenerator(const WorldOptions& options, const world::BlockRegistry& blocks);

// The parts refer to each other by address: made in place, destroyed in reverse order.
struct WorldSession {
    static base::Result<std::unique_ptr<WorldSession>> create(
        WorldOptions options, const SaveOptions& save,
        store::WorldAccess access = store::WorldAccess::ReadWriteOrMemory);
    WorldSession(world::BlockRegistry registry, unsigned threads);

    // Waits until all that changed is in the save.
    base::Result<void> save();

    // Lets game time pass: plants near `centre` grow.
    void advance(double seconds, world::ChunkPos centre);

    world::BlockRegistry blocks;
    light::LightTable lights;
    std::unique_ptr<store::ChunkStore> store;  // in memory without a save
    std::unique_ptr<gen::Generator> generator;
    world::World world;
    base::JobSystem jobs;
    std::unique_ptr<stream::ChunkPipeline> pipeline;

  private:
    double untilTick_ = 0;  // seconds of game time that made no tick yet
    std::uint64_t ticks_ = 0;
};

// Whether the camera is in water: below its surface, where that is in the same block.
bool isUnderWater(const WorldSession& session, const render::Camera& camera);

// Where everything has become sky.
inline float fogDistance(int viewDistance) {
    return static_cast<float>(viewDistance) * static_cast<float>(world::kChunkSize);
}

}  // namespace terrane::app
