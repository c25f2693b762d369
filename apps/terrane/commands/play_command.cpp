// terrane play: a window to fly through the world.
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/content.h"
#include "apps/terrane/scenes.h"
#include "apps/terrane/window/fly_camera.h"
#include "apps/terrane/world_session.h"
#include "terrane/base/log.h"
#include "terrane/gpu/window.h"
#include "terrane/world/ray_cast.h"

namespace terrane::app {
namespace {

struct PlayOptions {
    WorldOptions world;
    SaveOptions save;
    GraphicsOptions graphics;
    bool fullScreen = false;
};

// Chunks handed to the GPU a frame: about 64 × 10 KiB.
constexpr std::size_t kUploadsPerFrame = 64;

// Where the camera looks over the ground, in sixteenths of a circle: chunks are put in order again only when
// it turns.
glm::vec2 lookSector(const render::Camera& camera) {
    const glm::vec3 look = render::lookDirection(camera);
    const double sector = std::numbers::pi / 8;
    const double angle = std::round(std::atan2(double{look.y}, double{look.x}) / sector) * sector;
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

class PlayLoop {
  public:
    PlayLoop(const PlayOptions& options, const render::RenderOptions& graphics, gpu::Window& window,
             WorldSession& session, render::Renderer& renderer)
        : options_(options),
          graphics_(graphics),
          window_(window),
          session_(session),
          renderer_(renderer),
          camera_(findScene("landscape")->camera) {
        if (session_.store) restoreCamera();
    }

    base::Result<void> run() {
        double last = window_.timeSeconds();
        while (!window_.shouldClose()) {
            window_.pollEvents();
            handleEvents();
            const double now = window_.timeSeconds();
            // A long stall moves the camera no farther than a tenth of a second would.
            fly(camera_, flyKeys(), static_cast<float>(std::min(now - last, 0.1)));
            last = now;
            const glm::ivec2 size = window_.framebufferSize();
            if (size.x == 0 || size.y == 0) continue;  // minimised
            if (auto drawn = drawFrame(size, static_cast<float>(now)); !drawn) return drawn;
            ++frames_;
        }
        base::logInfo("closed after {} frames at {:.2f},{:.2f},{:.2f}", frames_, camera_.position.x,
                      camera_.position.y, camera_.position.z);
        return leave();
    }

  private:
    void handleEvents() {
        using Type = gpu::InputEvent::Type;
        for (const gpu::InputEvent& event : window_.events()) {
            if (event.type == Type::KeyPress && event.key == gpu::Key::Escape) window_.requestClose();
            const bool toggles = event.type == Type::ButtonPress && event.button == gpu::MouseButton::Middle;
            const bool captures = event.type == Type::ButtonPress && !isCaptured_;
            if (event.type == Type::ButtonPress && isCaptured_) build(event.button);
            if (toggles || captures) {
                isCaptured_ = !isCaptured_;
                window_.setCursorCaptured(isCaptured_);
            }
            if (event.type == Type::CursorMove && isCaptured_) turn(camera_, event.x, event.y);
        }
    }

    // The left button breaks the block that is looked at, the right one builds on it.
    void build(gpu::MouseButton button) {
        constexpr double kReach = 8;  // blocks
        const auto hit =
            world::castRay(session_.world, session_.blocks,
                           {camera_.position, glm::dvec3(render::lookDirection(camera_))}, kReach);
        if (!hit) return;
        if (button == gpu::MouseButton::Left) session_.setBlock(hit->block, world::kAir);
        if (button != gpu::MouseButton::Right) return;
        constexpr std::array<glm::ivec3, 6> kOut = {
            {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
        const glm::ivec3 out = kOut[hit->face];
        session_.setBlock({hit->block.x + out.x, hit->block.y + out.y, hit->block.z + out.z},
                          session_.blocks.find("stone")->id);
    }

    // "X Y Z YAW PITCH", as the save keeps it.
    static constexpr std::string_view kCameraSetting = "camera";

    void restoreCamera() {
        std::istringstream text(session_.store->setting(kCameraSetting).value_or(""));
        render::Camera saved;
        text >> saved.position.x >> saved.position.y >> saved.position.z >> saved.yaw >> saved.pitch;
        if (text && world::isInWorld(render::cameraChunk(saved))) camera_ = saved;
    }

    base::Result<void> leave() {
        session_.pipeline->saveAll();
        if (!session_.store) return {};
        const glm::dvec3& p = camera_.position;
        session_.store->setSetting(kCameraSetting,
                                   fmt::format("{} {} {} {} {}", p.x, p.y, p.z, camera_.yaw, camera_.pitch));
        return session_.store->flush();
    }

    FlyKeys flyKeys() const {
        using gpu::Key;
        return {.forward = window_.keyDown(Key::W),
                .back = window_.keyDown(Key::S),
                .left = window_.keyDown(Key::A),
                .right = window_.keyDown(Key::D),
                .up = window_.keyDown(Key::E) || window_.keyDown(Key::Shift),
                .down = window_.keyDown(Key::Q) || window_.keyDown(Key::Control)};
    }

    base::Result<void> drawFrame(glm::ivec2 size, float seconds) {
        if (size != renderer_.size()) {
            if (auto configured = renderer_.configure(size, graphics_); !configured) return configured;
        }
        session_.pipeline->setView(render::cameraChunk(camera_), options_.graphics.viewDistance,
                                   lookSector(camera_));
        session_.pipeline->update();
        uploadChanges(*session_.pipeline, renderer_, kUploadsPerFrame);
        renderer_.draw({camera_, world::environmentAt(0.38f), fogDistance(options_.graphics.viewDistance),
                        seconds, options_.graphics.view, isUnderWater(session_, camera_)});
        renderer_.presentToWindow(size);
        window_.swapBuffers();
        return {};
    }

    const PlayOptions& options_;
    render::RenderOptions graphics_;
    gpu::Window& window_;
    WorldSession& session_;
    render::Renderer& renderer_;
    render::Camera camera_;
    bool isCaptured_ = false;
    std::size_t frames_ = 0;
};

base::Result<void> play(const PlayOptions& options, const CLI::App& command) {
    auto session = WorldSession::create(options.world, options.save, command);
    if (!session) return tl::unexpected(session.error());
    auto window = gpu::Window::create({.title = "Terrane",
                                       .width = options.graphics.size.x,
                                       .height = options.graphics.size.y,
                                       .fullScreen = options.fullScreen,
                                       .debug = options.graphics.debugGl});
    if (!window) return tl::unexpected(window.error());
    const gpu::ShaderLoader shaders = makeShaderLoader(options.graphics.shaderRoot);
    const gpu::DeviceInfo device = gpu::queryDevice();
    auto renderer = render::Renderer::create(shaders, (*session)->blocks, builtInTextures(), device);
    if (!renderer) return tl::unexpected(renderer.error());
    (*session)->pipeline->setMeshOptions(options.graphics.mesh);
    renderer->setViewDistance(options.graphics.viewDistance);
    const auto graphics = renderOptions(options.graphics.choices, device.software);
    if (auto played = PlayLoop(options, graphics, *window, **session, *renderer).run(); !played)
        return played;
    if (window->debugLog() && window->debugLog()->errorCount() > 0) {
        return base::fail("the graphics driver reported errors, see above");
    }
    return {};
}

}  // namespace

CommandEntry addPlay(CLI::App& app) {
    auto options = std::make_shared<PlayOptions>();
    CLI::App* command = app.add_subcommand("play", "Open a window and fly through the world (the default)");
    addWorldOptions(*command, options->world);
    addGraphicsOptions(*command, options->graphics, "auto");
    command->add_flag("--full-screen", options->fullScreen, "Take the whole screen");
    addSaveGameOptions(*command, options->save);
    return {command, [options, command] { return play(*options, *command); }};
}

}  // namespace terrane::app
