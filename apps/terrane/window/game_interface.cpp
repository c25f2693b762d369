// What the window's loop draws over the image.
#include <algorithm>
#include <glm/geometric.hpp>

#include "apps/terrane/window/container_panel.h"
#include "apps/terrane/window/game.h"
#include "apps/terrane/window/loading_map.h"
#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/panel.h"
#include "terrane/base/process_statistics.h"
#include "terrane/game/container.h"
#include "terrane/view/camera_pose.h"

namespace terrane::app {

// To the sun or moon; none where there are no shadows.
std::optional<glm::vec3> Game::shadowLight() const {
    const render::RenderOptions& options = parts_.renderer.options();
    if (options.shadows == render::ShadowReach::Off || options.shading == render::Shading::Off)
        return std::nullopt;
    return world::environmentAt(static_cast<float>(parts_.session.clock.timeDay)).lightDirection;
}

void Game::drawInterface(double seconds) {
    game::Session& session = parts_.session;
    const stream::Progress progress = session.pipeline().progress();
    imgui_.setTextSize(settings_.textSize);
    imgui_.beginFrame(isCaptured_, isInMenu() || hud_.hasDialog());
    const Screen screen{imgui_.size().x, imgui_.size().y};
    const render::Camera camera = this->camera();
    if (isAbove_) {
        const int viewDistance = parts_.view.viewDistance();
        drawDebugTopView(screen, debugTopCamera(camera, viewDistance), camera,
                         view::fogDistance(viewDistance), shadowLight());
    } else if (const auto& target = interaction_.target()) {
        drawTarget(screen, camera, *target, {session.world(), session.blocks(), settings_.highContrast});
    }
    drawRemote(screen, camera);
    drawBuilding(screen);
    if (isCaptured_ && !isAbove_) drawCrosshair(screen);
    drawHud(screen, camera, seconds);
    if (hintSeconds_ > 0) drawHint(screen, static_cast<float>(std::min(hintSeconds_, 1.0)), tr_);
    if (messageSeconds_ > 0)
        drawMessage(screen, message_, static_cast<float>(std::min(messageSeconds_, 1.0)));
    wasComplete_ = wasComplete_ || progress.complete();
    if (!wasComplete_) drawProgress(screen, progress, tr_);
    if (showsLoading_) drawLoadingMap(screen, session.pipeline(), session.tiles().table());
    if (showsPanel_) drawStatistics(statistics(), screen.width - panelWidth() - 30 * uiScale());
    if (showsPanel_) drawPanel(settings_, session.clock, {isSoftwareRenderer_, screen.width, screen.height});
    if (container_) drawOpenContainer(screen);
    if (showsSettings_ && !asksToQuit_) {
        if (settingsDialog_.draw(settings_, {screen, tr_, isSoftwareRenderer_, &session.clock})) closeOne();
    } else if (isPaused_ && !asksToQuit_)
        if (const auto choice = drawPauseMenu(screen, tr_)) answerPauseMenu(*choice);
    const store::SaveStatus status = session.store().status();
    if (!asksToQuit_) {
        drawSaveNotice(screen, status, tr_);
    } else if (const auto choice = drawQuitDialog(screen, status, tr_)) {
        answerQuitDialog(*choice);
    }
    imgui_.endFrame();
}

// A chest that is gone or out of reach closes.
void Game::drawOpenContainer(const Screen& screen) {
    game::Session& session = parts_.session;
    const glm::dvec3 middle(container_->x + 0.5, container_->y + 0.5, container_->z + 0.5);
    const bool isNear = glm::distance(middle, player_.pose().position) <= game::kReach + 1;
    if (!isNear || !game::isContainer(session.world(), session.blocks(), *container_))
        return closeContainer();
    auto items = game::itemsOf(session.world(), session.blocks(), *container_);
    if (!items) {
        say(items.error().message);
        return closeContainer();
    }
    const auto image = [&](const std::string& item) {
        const world::BlockType* kind = session.blocks().find(item);
        return kind ? parts_.preview.image(kind->id) : 0;
    };
    const auto name = [&](const std::string& item) {
        const world::BlockType* kind = session.blocks().find(item);
        return kind ? tr_.block(*kind) : item;
    };
    const auto click = drawContainer(screen, *items, {image, name}, tr_);
    world::BlockId inHand = interaction_.block();
    if (!click || !game::clickSlot(*items, session.blocks(), *click, inHand)) return;
    game::takeInHand(interaction_.hotbar, inHand);
    game::putItems(session, game::kLocalPlayer, *container_, *items);
}

MemoryStatistics Game::memoryStatistics() const {
    return {.blocks = parts_.session.world().memoryBytes(),
            .light = parts_.session.pipeline().lightBytes(),
            .quads = parts_.renderer.quadBytes(),
            .lightOnGpu = parts_.renderer.lightBytes(),
            .onGpu = parts_.renderer.memory().total(),
            .gpuBudget = parts_.renderer.memoryBudget(),
            .resident = base::residentBytes()};
}

Statistics Game::statistics() {
    const game::Session& session = parts_.session;
    return {.frames = &meter_,
            .camera = camera(),
            .timeDay = parts_.session.clock.timeDay,
            .progress = session.pipeline().progress(),
            .tiles = &session.tiles().table(),
            .activeChunks = session.world().chunkCount(),
            .queuedChunks = session.pipeline().queuedCount() + parts_.view.waiting(),
            .frame = parts_.renderer.statistics(),
            .memory = memory_.at(seconds_, [&] { return memoryStatistics(); }),
            .tasks = session.taskTimes(),
            .passes = &parts_.renderer.passTimes()};
}

}  // namespace terrane::app
