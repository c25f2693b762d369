#include "apps/terrane/window/title/title_background.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/trigonometric.hpp>
#include <thread>

#include "terrane/base/log.h"
#include "terrane/game/player_state.h"
#include "terrane/game/spawn.h"
#include "terrane/gpu/framebuffer.h"
#include "terrane/io/open_session.h"
#include "terrane/view/camera_path.h"

namespace terrane::app {
namespace {

constexpr double kRadius = 40, kRoundSeconds = 300;  // blocks; 0.8 blocks a second
constexpr double kOverGround = 10, kUnderTop = 21;   // blocks over the ground; under the world's top
constexpr double kMorning = 0.33;                    // of a day
constexpr int kMostChunks = 8, kMostHorizon = 256;
constexpr std::chrono::milliseconds kPause{15};  // pause between frames without a world

base::Result<std::unique_ptr<WorldOnScreen>> openWorld(const PlayOptions& options,
                                                       const ScreenOptions& screen,
                                                       const std::filesystem::path& save) {
    io::WorldOptions world{.seed = {},
                           .seedText = {},
                           .generator = {},
                           .content = options.world.content,
                           .threads = options.world.threads};
    const io::SaveOptions from{.world = save.string(), .storeGenerated = {}};
    auto opened = TERRANE_TRY(io::openSessionParts(world, from, store::WorldAccess::ReadOnly));
    return WorldOnScreen::create(std::move(opened), screen);
}

int highestBlock(const world::Chunk& chunk) {
    const world::Heights heights = chunk.heights();
    for (int z = heights.top - 1; z >= heights.bottom; --z)
        for (int y = 3; y < world::kChunkSize; y += 8)
            for (int x = 3; x < world::kChunkSize; x += 8)
                if (chunk.block(world::blockIndex(x, y, z)) != 0) return z;
    return heights.bottom;
}

// An altitude above all ground on the flight.
double flightHeight(const gen::Generator& generator, const glm::dvec3& center) {
    double highest = center.z;
    constexpr int kSteps = 16;
    for (int step = 0; step < kSteps; ++step) {
        const world::Pose pose = flightPose(center, kRoundSeconds * step / kSteps);
        const world::Chunk chunk = generator.generate(world::chunkOf(pose.position));
        highest = std::max(highest, highestBlock(chunk) + kOverGround);
    }
    return std::min(highest, generator.heights().top - kUnderTop);
}

}  // namespace

world::Pose flightPose(const glm::dvec3& center, double seconds) {
    constexpr double kInward = 25, kDown = -12;  // degrees
    const double turn = 360 * std::fmod(seconds / kRoundSeconds, 1.0), angle = glm::radians(turn);
    const glm::dvec3 at = center + kRadius * glm::dvec3(std::cos(angle), std::sin(angle), 0);
    return {at, static_cast<float>(std::fmod(turn + 90 + kInward, 360.0)), static_cast<float>(kDown)};
}

base::Result<TitleBackground> TitleBackground::open(const PlayOptions& options, const ScreenOptions& screen,
                                                    const std::filesystem::path& save) {
    auto world = openWorld(options, screen, save);
    std::filesystem::path shown = save;
    if (!world && !save.empty()) {
        base::logInfo("not shown behind the title: {}", world.error().message);
        world = openWorld(options, screen, "");
        shown.clear();
    }
    if (!world) return tl::unexpected(world.error());
    TitleBackground background(std::move(*world), shown);
    background.begin(options, screen);
    return background;
}

void TitleBackground::begin(const PlayOptions& options, const ScreenOptions& screen) {
    game::Session& session = world_->session();
    const game::SavedPlayer saved = game::loadPlayer(session.store());
    const world::Pose start =
        saved.pose ? *saved.pose : game::findSpawn(session.generator(), session.blocks());
    center_ = start.position;
    center_.z = flightHeight(session.generator(), center_);
    // Without a graphics card menus must stay responsive: a quarter of the pixels.
    const render::GraphicsSettings low = render::settingsOf({"low"}, true);
    const render::GraphicsSettings chosen =
        render::settingsOf(options.graphics.choices, screen.device.software);
    const render::GraphicsSettings& graphics = screen.device.software ? low : chosen;
    render_ = graphics.render;
    pixelsShare_ = screen.device.software ? 2 : 1;
    viewDistance_ = std::min(chosen.viewDistance, kMostChunks);
    session.pipeline().setMeshOptions(graphics.mesh);
    world_->renderer().setViewDistance(viewDistance_);
    world_->view().setHorizon({std::min(chosen.horizon, kMostHorizon), graphics.detail});
}

base::Result<bool> TitleBackground::configure(glm::ivec2 size) {
    render::Renderer& renderer = world_->renderer();
    if (renderer.size() == size) return true;
    if (!world_->compiler().isReady(size, render_, {renderer.hasTint(), renderer.hasLand()}))
        return hasImage();
    TERRANE_TRY(renderer.configure(size, render_));
    return true;
}

base::Result<void> TitleBackground::draw(glm::ivec2 windowSize, double seconds, bool isStill) {
    seconds_ += seconds;
    if (!isStill) flightSeconds_ += seconds;
    const render::Camera camera = view::cameraOf(flightPose(center_, flightSeconds_));
    world_->view().follow(camera, viewDistance_);
    const world::Environment environment = world::environmentAt(static_cast<float>(kMorning));
    const auto configured = TERRANE_TRY(configure(glm::max(windowSize / pixelsShare_, glm::ivec2(1))));
    if (!configured) {
        gpu::clearWindow(glm::pow(glm::min(environment.horizonColor, 1.0f), glm::vec3(1 / 2.2f)));
        std::this_thread::sleep_for(kPause);
        return {};
    }
    world_->view().upload(view::uploadBudget(seconds, world_->view().missing()));
    render::FrameInput input;
    input.camera = camera;
    input.environment = environment;
    input.fogDistance = view::fogDistance(world_->view().visibleDistance());
    input.timeSeconds = static_cast<float>(isStill ? 0 : seconds_);
    input.maxShadowTiles = render::ShadowClipmap::kTilesPerFrame;
    input.maxLitChunks = render::CornerLitChunks::kPerFrame;
    world_->renderer().draw(input);
    world_->renderer().presentToWindow(windowSize);
    return {};
}

}  // namespace terrane::app
