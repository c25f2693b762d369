#include "apps/terrane/window/game/game_statistics.h"

#include "terrane/base/machine.h"

namespace terrane::app {
namespace {

MemoryStatistics memoryOf(const GameParts& parts) {
    return {.blocks = parts.session.world().memoryBytes(),
            .light = parts.session.pipeline().lightBytes(),
            .quads = parts.renderer.quadBytes(),
            .lightOnGpu = parts.renderer.lightBytes(),
            .onGpu = parts.renderer.memory().total(),
            .gpuBudget = parts.renderer.memoryBudget(),
            .resident = base::residentBytes()};
}

}  // namespace

Statistics statisticsOf(GameState& game) {
    const GameParts& parts = game.parts;
    const game::Session& session = parts.session;
    return {.frames = &game.meter,
            .camera = cameraOf(game.player, game.settings),
            .timeDay = session.clock.timeDay,
            .progress = session.pipeline().progress(),
            .tiles = &session.tiles().table(),
            .activeChunks = session.world().chunkCount(),
            .queuedChunks = session.pipeline().queuedCount() + parts.view.waiting(),
            .frame = parts.renderer.statistics(),
            .memory = game.memory.at(game.seconds, [&] { return memoryOf(parts); }),
            .tasks = session.taskTimes(),
            .passes = &parts.renderer.passTimes()};
}

}  // namespace terrane::app
