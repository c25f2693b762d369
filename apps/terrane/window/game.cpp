#include "apps/terrane/window/game.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <thread>

#include "apps/terrane/window/container_panel.h"
#include "apps/terrane/window/loading_map.h"
#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/panel.h"
#include "terrane/base/log.h"
#include "terrane/base/process_statistics.h"
#include "terrane/content/resource_pack.h"
#include "terrane/game/container.h"
#include "terrane/gpu/framebuffer.h"
#include "terrane/view/camera_pose.h"

namespace terrane::app {
namespace {

// Between frames that show no world, so that the compiler has the CPU.
constexpr std::chrono::milliseconds kCompilePause{15};

}  // namespace

Game::Game(const GameParts& parts, const GameOptions& options)
    : parts_(parts),
      settings_(options.settings),
      applied_(options.settings),
      isSoftwareRenderer_(options.isSoftwareRenderer),
      imgui_(parts.window),
      player_(options.start, options.settings.movement),
      interaction_(parts.session.blocks()),
      shadersRead_(parts.shaders.newestWrite()),
      screenshots_(options.dataFolder / "screenshots"),
      bookmarks_(game::bookmarkFiles(options.dataFolder)),
      perfData_(options.perfData),
      deviceName_(options.deviceName) {
    if (options.measuresPreset) beginMeasurement();
    if (const world::BlockType* hand = parts_.session.blocks().find(options.hand))
        interaction_.choose(hand->id);
    parts_.session.pipeline().setMeshOptions(settings_.graphics.mesh);
    parts_.renderer.setViewDistance(settings_.graphics.viewDistance);
}

base::Result<void> Game::run() {
    if (!perfData_.empty()) {
        auto log = PerfLog::create(perfData_);
        if (!log) return tl::unexpected(log.error());
        perfLog_ = std::move(*log);
    }
    base::Result<void> drawn, saved;
    do {
        drawn = drawFrames();
        saved = save();
    } while (drawn && staysAfter(saved));
    const glm::dvec3& p = player_.pose().position;
    base::logInfo("closed after {} frames at {:.2f},{:.2f},{:.2f}", frames_, p.x, p.y, p.z);
    if (perfLog_) base::logInfo("most seconds had {} frames", meter_.mode());
    if (!drawn && !saved) base::logError("{}", saved.error().message);
    if (!drawn || !saved) return drawn ? saved : drawn;
    return perfLog_ ? perfLog_->finish() : base::Result<void>();
}

base::Result<void> Game::drawFrames() {
    double last = parts_.window.timeSeconds();
    while (!parts_.window.shouldClose() && !parts_.signals.stopAsked()) {
        parts_.window.pollEvents();
        handleEvents();
        const double now = parts_.window.timeSeconds(), seconds = now - last;
        last = now;
        meter_.add(seconds);
        advance(seconds);
        applySettings();
        reloadWrittenShaders();
        if (auto drawn = drawFrame(seconds); !drawn) return drawn;
        if (perfLog_) perfLog_->add(seconds_, seconds, statistics());
    }
    return {};
}

void Game::advance(double seconds) {
    game::Session& session = parts_.session;
    seconds_ += seconds;
    hintSeconds_ -= seconds;
    messageSeconds_ -= seconds;
    session.clock.dayMinutes = settings_.dayMinutes;
    onPad(seconds);
    player_.move(session.world(), session.blocks(), moveKeys(), seconds);
    session.setPlayer(game::kLocalPlayer, player_.pose());
    interaction_.act(session, game::kLocalPlayer, player_, seconds);
    session.advance(seconds, world::chunkOf(player_.pose().position));
    game::savePlayer(session.store(), playerState(), saved_);
    parts_.view.setHorizon({settings_.graphics.horizon, settings_.graphics.detail});
    parts_.view.follow(camera(), settings_.graphics.viewDistance);
}

// What changed since the last frame; the renderer sees to its own options with the frame's size.
void Game::applySettings() {
    if (settings_ == applied_) return;
    if (settings_.preset != applied_.preset || settings_.graphics != applied_.graphics) endMeasurement();
    if (settings_.graphics.mesh != applied_.graphics.mesh)
        parts_.session.pipeline().setMeshOptions(settings_.graphics.mesh);
    if (settings_.graphics.viewDistance != applied_.graphics.viewDistance) {
        parts_.renderer.setViewDistance(settings_.graphics.viewDistance);
        parts_.session.pipeline().resendLight();
    }
    if (settings_.movement != applied_.movement) player_.setMovement(settings_.movement);
    if (settings_.fullScreen != applied_.fullScreen) parts_.window.setFullScreen(settings_.fullScreen);
    if (settings_.resourcePack != applied_.resourcePack) {
        const auto changed = useResourcePack(settings_.resourcePack);
        if (!changed) settings_.resourcePack = applied_.resourcePack;
        say(changed ? "textures are loaded" : changed.error().message);
    }
    applied_ = settings_;
}

base::Result<void> Game::useResourcePack(const std::string& folder) {
    auto textures = content::loadTextures(folder, parts_.session.blocks());
    if (!textures) return tl::unexpected(textures.error());
    if (auto set = parts_.renderer.setTextures(parts_.session.blocks(), *textures); !set) return set;
    return parts_.preview.setTextures(*textures);
}

base::Result<void> Game::drawFrame(double seconds) {
    const glm::ivec2 size = parts_.window.framebufferSize();
    if (size.x == 0 || size.y == 0) return {};  // minimised
    if (auto configured = configureRenderer(size); !configured) return configured;
    if (hasWorldImage()) {
        parts_.view.upload(view::uploadBudget(seconds, parts_.view.missing()));
        if (auto notice = parts_.view.takeNotice()) say(std::move(*notice));
        parts_.renderer.draw(frameInput());
        parts_.renderer.presentToWindow(size);
        measurePreset(seconds);
        sayPreset();
    } else {
        const glm::vec3 sky =
            world::environmentAt(static_cast<float>(parts_.session.clock.timeDay)).horizonColor;
        gpu::clearWindow(glm::pow(glm::min(sky, 1.0f), glm::vec3(1 / 2.2f)));
        std::this_thread::sleep_for(kCompilePause);
    }
    drawInterface();
    parts_.window.swapBuffers();
    ++frames_;
    return {};
}

render::Camera Game::camera() const {
    return view::cameraOf(player_.pose(), settings_.fieldOfView);
}

render::FrameInput Game::frameInput() const {
    render::FrameInput input;
    input.camera = camera();
    input.environment = world::environmentAt(static_cast<float>(parts_.session.clock.timeDay));
    input.fogDistance = view::fogDistance(parts_.view.sightDistance());
    input.timeSeconds = static_cast<float>(seconds_);
    input.view = settings_.view;
    input.waterAbove = game::waterAbove(parts_.session, player_.pose().position);
    input.maxShadowTiles = render::ShadowClipmap::kTilesAFrame;
    if (isAbove_) {
        input.culledFor = input.camera;
        input.camera = debugTopCamera(camera(), parts_.view.viewDistance());
        input.fogDistance = 16 * view::fogDistance(parts_.view.viewDistance());
        input.waterAbove = 0;
    }
    return input;
}

// To the sun or moon; none where there are no shadows.
std::optional<glm::vec3> Game::shadowLight() const {
    const render::RenderOptions& options = parts_.renderer.options();
    if (options.shadows == render::ShadowReach::Off || options.shading == render::Shading::Off)
        return std::nullopt;
    return world::environmentAt(static_cast<float>(parts_.session.clock.timeDay)).lightDirection;
}

void Game::drawInterface() {
    game::Session& session = parts_.session;
    const stream::Progress progress = session.pipeline().progress();
    imgui_.beginFrame(isCaptured_);
    const Screen screen{imgui_.size().x, imgui_.size().y};
    const render::Camera camera = this->camera();
    if (isAbove_) {
        const int viewDistance = parts_.view.viewDistance();
        drawDebugTopView(screen, debugTopCamera(camera, viewDistance), camera,
                         view::fogDistance(viewDistance), shadowLight());
    } else if (const auto& target = interaction_.target()) {
        drawTarget(screen, camera, *target, session.world(), session.blocks());
    }
    if (isCaptured_ && !isAbove_) drawCrosshair(screen);
    drawHand(screen, session.blocks().type(interaction_.block()).name,
             hasWorldImage() ? parts_.preview.image(interaction_.block()) : 0);
    if (hintSeconds_ > 0) drawHint(screen, static_cast<float>(std::min(hintSeconds_, 1.0)));
    if (messageSeconds_ > 0)
        drawMessage(screen, message_, static_cast<float>(std::min(messageSeconds_, 1.0)));
    if (!progress.complete()) drawProgress(screen, progress);
    if (showsLoading_) drawLoadingMap(screen, session.pipeline(), session.tiles().table());
    if (showsPanel_) drawStatistics(statistics());
    if (showsPanel_) drawPanel(settings_, session.clock, {isSoftwareRenderer_, screen.width, screen.height});
    if (container_) drawOpenContainer(screen);
    const store::SaveStatus status = session.store().status();
    if (!asksToQuit_) {
        drawSaveNotice(screen, status);
    } else if (const auto choice = drawQuitDialog(screen, status)) {
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
    const auto click = drawContainer(screen, *items, image);
    world::BlockId inHand = interaction_.block();
    if (!click || !game::clickSlot(*items, session.blocks(), *click, inHand)) return;
    interaction_.choose(inHand);
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

game::PlayerState Game::playerState() const {
    return {player_.pose(), parts_.session.clock.timeDay,
            parts_.session.blocks().type(interaction_.block()).name};
}

base::Result<void> Game::save() {
    game::savePlayer(parts_.session.store(), playerState(), saved_);
    const auto saved = parts_.session.save();
    if (saved) return saved;
    return base::fail(saved.error().code, "{}; not saved: {} chunks", saved.error().message,
                      parts_.session.store().status().waiting);
}

// Who closes the window is asked before anything is lost; who sends a signal is not there to answer.
bool Game::staysAfter(const base::Result<void>& saved) {
    if (saved || quitsUnsaved_ || parts_.signals.stopAsked()) return false;
    parts_.window.cancelClose();
    asksToQuit_ = true;
    capture(false);
    return true;
}

void Game::answerQuitDialog(QuitChoice choice) {
    asksToQuit_ = false;
    quitsUnsaved_ = choice == QuitChoice::QuitUnsaved;
    if (choice != QuitChoice::Stay) parts_.window.requestClose();
}

}  // namespace terrane::app
