#include "apps/terrane/world_session.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <glm/common.hpp>
#include <limits>

#include "apps/terrane/content.h"
#include "apps/terrane/save_identity.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/shared/shape_face.h"
#include "terrane/store/memory_store.h"
#include "terrane/store/open_store.h"
#include "terrane/store/save_path.h"
#include "terrane/world/plant_growth.h"

namespace terrane::app {
namespace {

base::Result<std::unique_ptr<store::ChunkStore>> openSave(WorldOptions& options, const SaveOptions& save,
                                                          const CLI::App& command,
                                                          const world::BlockRegistry& blocks) {
    // Edits of chunks that are left and come back.
    if (save.name.empty()) return std::make_unique<store::MemoryStore>(identityOf(options));
    auto path = store::savePath(save.name, store::savePlaces());
    if (!path) return tl::unexpected(path.error());
    return store::openStore(*path, blocks, accessTo({*path, save.recreate}, options, command));
}

}  // namespace

base::Result<gen::Generator> makeGenerator(const WorldOptions& options, const world::BlockRegistry& blocks) {
    auto graph = gen::makeGenerator(options.generator, blocks);
    if (!graph) return tl::unexpected(graph.error());
    return gen::Generator(std::move(*graph), options.seed);
}

void addSaveGameOptions(CLI::App& command, SaveOptions& options) {
    command.add_option("--save-game", options.name, "Save of the world, by name; made where it is not there");
    command.add_flag("--recreate", options.recreate, "Copy the save and make the world anew; edits are gone")
        ->needs("--save-game");
}

WorldSession::WorldSession(world::BlockRegistry registry, unsigned threads)
    : blocks(std::move(registry)), lights(blocks), jobs(threads) {}

base::Result<std::unique_ptr<WorldSession>> WorldSession::create(WorldOptions options,
                                                                 const SaveOptions& save,
                                                                 const CLI::App& command) {
    auto blocks = loadBlocks();
    if (!blocks) return tl::unexpected(blocks.error());
    // Before a save is made: a generator that does not exist has none.
    auto known = makeGenerator(options, *blocks);
    if (!known) return tl::unexpected(known.error());
    auto session = std::make_unique<WorldSession>(std::move(*blocks), threadCount(options));
    auto opened = openSave(options, save, command, session->blocks);
    if (!opened) return tl::unexpected(opened.error());
    session->store = std::move(*opened);
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
