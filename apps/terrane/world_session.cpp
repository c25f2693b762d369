#include "apps/terrane/world_session.h"

#include <algorithm>
#include <chrono>
#include <glm/common.hpp>
#include <limits>

#include "apps/terrane/content.h"
#include "apps/terrane/open_save.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/shared/shape_face.h"
#include "terrane/store/memory_store.h"
#include "terrane/world/plant_growth.h"

namespace terrane::app {
base::Result<gen::Generator> makeGenerator(const WorldOptions& options, const world::BlockRegistry& blocks) {
    auto graph = gen::makeGenerator(options.effectiveGenerator(), blocks);
    if (!graph) return tl::unexpected(graph.error());
    return gen::Generator(std::move(*graph), options.effectiveSeed());
}

WorldSession::WorldSession(world::BlockRegistry registry, unsigned threads)
    : blocks(std::move(registry)), lights(blocks), jobs(threads) {}

base::Result<std::unique_ptr<WorldSession>> WorldSession::create(WorldOptions options,
                                                                 const SaveOptions& save,
                                                                 store::WorldAccess access) {
    auto blocks = loadBlocks();
    if (!blocks) return tl::unexpected(blocks.error());
    auto session = std::make_unique<WorldSession>(std::move(*blocks), threadCount(options));
    auto opened = openSave(options, save, access, session->blocks);
    if (!opened) return tl::unexpected(opened.error());
    session->store = std::move(*opened);
    // Edits of chunks that are left and come back.
    if (!session->store) session->store = std::make_unique<store::MemoryStore>(identityOf(options));
    auto generator = makeGenerator(options, session->blocks);
    if (!generator) return tl::unexpected(generator.error());
    session->generator = std::make_unique<gen::Generator>(std::move(*generator));
    // Loading is about ten times as fast as generating (docs/performance.md): generated chunks are stored
    // too.
    session->pipeline = std::make_unique<stream::ChunkPipeline>(stream::PipelineParts{
        session->jobs,
        session->blocks,
        session->lights,
        session->world,
        {session->generator.get(), session->store.get(), session->store->isPersistent()},
        nullptr});
    return session;
}

base::Result<void> WorldSession::save() {
    pipeline->saveAll();
    return store ? store->flush() : base::Result<void>();
}

void WorldSession::advance(double seconds, world::ChunkPos centre) {
    const double tickSeconds = std::chrono::duration<double>(world::kTickLength).count();
    // After a stall plants grow as if it had been shorter.
    untilTick_ += std::min(seconds, 1.0);
    for (; untilTick_ >= tickSeconds; untilTick_ -= tickSeconds) {
        for (const world::BlockPos pos : world::plantsThatGrow(world, blocks, {ticks_++, centre})) {
            pipeline->setSmallData(pos, static_cast<std::uint16_t>(world.smallData(pos) - 1));
        }
    }
}

bool isUnderWater(const WorldSession& session, const render::Camera& camera) {
    const glm::dvec3 at = glm::floor(camera.position);
    const world::BlockId water = session.blocks.find("water")->id;
    const world::BlockPos pos{static_cast<std::int32_t>(at.x), static_cast<std::int32_t>(at.y),
                              static_cast<std::int32_t>(at.z)};
    if (session.world.block(pos) != water) return false;
    constexpr double kSurface = shared::kLiquidSurfaceSixteenths / 16.0;
    const bool isFull = session.world.block({pos.x, pos.y, pos.z + 1}) == water;
    return isFull || camera.position.z - at.z < kSurface;
}

}  // namespace terrane::app
