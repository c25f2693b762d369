// A small game in a window: land of its own generator, a player who walks, breaks and places blocks, and one
// rule: who breaks glowing ore collects it. The world is saved. docs/start/game.md explains the program.
//
//     small_game WORLD.sqlite
//
// The mouse looks around; W A S D, Space, Shift: walk, jump, run; mouse buttons: break, place; Escape ends.
#define GLFW_INCLUDE_NONE  // Terrane declares OpenGL
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <thread>

#include "terrane/content/built_in.h"
#include "terrane/game/block_interaction.h"
#include "terrane/game/player.h"
#include "terrane/game/session.h"
#include "terrane/game/spawn.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/render/frame/graphics_table.h"
#include "terrane/store/saves/open_world.h"
#include "terrane/view/camera_path.h"
#include "terrane/view/gpu_back_ends.h"
#include "terrane/view/world_view.h"

namespace {

using namespace terrane;

constexpr const char* kGenerator = "ore_hills";
constexpr int kGeneratorVersion = 1;  // increment when generated blocks change
constexpr std::uint64_t kSeed = 7;
constexpr int kViewDistance = 12, kHorizon = 256;  // chunks
constexpr game::PlayerId kPlayer = 1;

void writeOreHills(gen::GeneratorBuilder& g) {
    using namespace gen;
    const auto height = g.field<Int>("height");
    g.pass2D("land", [&](Pass& p) {  // once per column
        p.set(height, Int(84.0f + p.perlin2D("hills", 32, {2.0f, 5.0f, 14.0f, 20.0f})));
    });
    g.pass3D("ground", [&](Pass& p) {  // once per block
        const Int depth = p.read(height) - p.z();
        auto block = p.var(select(p.z() <= 80, p.block("water"), p.block("air")));
        p.if_(depth >= 0, [&] { block = select(depth < 1, p.block("grass"), p.block("stone")); });
        p.if_(depth >= 0 && depth < 3 && p.z() <= 82, [&] { block = p.block("sand"); });
        const Bool isOre = depth == 0 && p.random2D("ore", p.x(), p.y()) < 0.01f;
        p.setBlock(select(isOre, p.block("glowing_ore"), Block(block)));
    });
}

gen::GeneratorCatalogue makeCatalogue() {
    gen::GeneratorCatalogue catalogue = gen::builtInGenerators();
    catalogue.push_back(
        {kGenerator, kGeneratorVersion, [](const world::BlockRegistry& blocks, gen::GraphRequest request) {
             gen::GeneratorBuilder g(kGenerator, blocks, request);
             writeOreHills(g);
             return g.finish();
         }});
    return catalogue;
}

// Opens the world, creating it if needed.
base::Result<game::SessionParts> openWorld(const std::string& path) {
    auto loaded = content::loadBlocks();
    if (!loaded) return tl::unexpected(loaded.error());
    const auto blocks = std::make_shared<const world::BlockRegistry>(std::move(*loaded));
    const gen::GeneratorCatalogue catalogue = makeCatalogue();
    store::WorldRequest request;
    request.create = store::WorldIdentity{kSeed, kGenerator, kGeneratorVersion};
    request.versionOf = [&](std::string_view name) { return gen::versionOf(catalogue, name); };
    auto store = store::openWorld(store::worldLocation(path), *blocks, request);
    if (!store) return tl::unexpected(store.error());
    const store::WorldIdentity& world = (*store)->identity();
    auto generators =
        gen::makeLevelGenerators(world.generator, *blocks, world.seed, catalogue, world.heights);
    if (!generators) return tl::unexpected(generators.error());
    const unsigned workers = std::max(2u, std::thread::hardware_concurrency()) - 1;
    return game::SessionParts{blocks, std::move(*generators), std::move(*store), workers};
}

// Makes the window's context current. Null without a display or OpenGL 4.5.
GLFWwindow* openWindow() {
    if (glfwInit() == GLFW_FALSE) return nullptr;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    GLFWwindow* window = glfwCreateWindow(1280, 720, "Ore hills", nullptr, nullptr);
    if (!window) return nullptr;
    glfwMakeContextCurrent(window);
    glfwSetInputMode(window, GLFW_CURSOR, GLFW_CURSOR_DISABLED);
    glfwSetInputMode(window, GLFW_STICKY_KEYS, GLFW_TRUE);  // a press counts, even one shorter than a frame
    glfwSetInputMode(window, GLFW_STICKY_MOUSE_BUTTONS, GLFW_TRUE);
    return window;
}

void turn(GLFWwindow* window, game::Player& player, glm::dvec2& cursor) {
    constexpr double kDegreesAPixel = 0.12;
    glm::dvec2 now;
    glfwGetCursorPos(window, &now.x, &now.y);
    const glm::dvec2 moved = (now - cursor) * kDegreesAPixel;
    player.turn(moved.x, moved.y);
    cursor = now;
}

game::MoveKeys keysOf(GLFWwindow* window) {
    const auto isDown = [&](int key) { return glfwGetKey(window, key) == GLFW_PRESS; };
    game::MoveKeys keys;
    keys.forward = isDown(GLFW_KEY_W);
    keys.back = isDown(GLFW_KEY_S);
    keys.left = isDown(GLFW_KEY_A);
    keys.right = isDown(GLFW_KEY_D);
    keys.jump = keys.up = isDown(GLFW_KEY_SPACE);
    keys.run = isDown(GLFW_KEY_LEFT_SHIFT);
    return keys;
}

void readButton(GLFWwindow* window, int button, game::HeldButton& held) {
    const bool isDown = glfwGetMouseButton(window, button) == GLFW_PRESS;
    if (isDown && !held.isDown()) held.press();
    if (!isDown) held.release();
}

base::Result<void> play(GLFWwindow* window, game::SessionParts parts) {
    const gpu::ShaderLoader shaders = gpu::builtInShaders("");
    const gpu::DeviceInfo device = gpu::queryDevice();
    auto renderer = render::Renderer::create(shaders, *parts.blocks, content::builtInTextures(), device);
    if (!renderer) return tl::unexpected(renderer.error());
    const render::GraphicsSettings graphics = render::settingsOf({"auto"}, device.software);
    renderer->setMemoryBudget(view::gpuMemoryBudget(device, {}));

    game::Session session(std::move(parts));
    session.pipeline().setMeshOptions(graphics.mesh);
    game::Player player(game::findSpawn(session.generator(), session.blocks()), game::Movement::Walk);
    game::BlockInteraction hands(session.blocks());
    int collected = 0;
    const world::BlockId ore = session.blocks().find("glowing_ore")->id;
    const game::Subscription counting = session.events.edited.add([&](const game::BlocksEdited& event) {
        for (const world::BlockEdit& edit : event.edits)
            collected += edit.before == ore && edit.after == world::kAir;
        glfwSetWindowTitle(window, ("Ore hills: " + std::to_string(collected) + " ore").c_str());
    });

    view::WorldView view(session, *renderer);
    view.setHorizon({kHorizon, graphics.detail});
    glm::ivec2 size(0);
    glm::dvec2 cursor;
    glfwGetCursorPos(window, &cursor.x, &cursor.y);
    for (double last = glfwGetTime(); !glfwWindowShouldClose(window);) {
        glfwPollEvents();
        const double now = glfwGetTime(), seconds = std::min(now - last, 0.1);
        last = now;
        if (glfwGetKey(window, GLFW_KEY_ESCAPE) == GLFW_PRESS) glfwSetWindowShouldClose(window, GLFW_TRUE);

        turn(window, player, cursor);
        player.move(session.world(), session.blocks(), keysOf(window), seconds);
        session.setPlayer(kPlayer, player.pose());
        readButton(window, GLFW_MOUSE_BUTTON_LEFT, hands.breaking);
        readButton(window, GLFW_MOUSE_BUTTON_RIGHT, hands.building);
        (void)hands.act(session, kPlayer, player, seconds);

        const render::Camera camera = view::cameraOf(player.pose());
        session.advance(seconds, render::cameraChunk(camera));
        view.follow(camera, kViewDistance);
        (void)view.upload(view::uploadBudget(seconds, view.missing()));

        glm::ivec2 pixels;
        glfwGetFramebufferSize(window, &pixels.x, &pixels.y);
        if (pixels.x == 0 || pixels.y == 0) continue;  // minimized
        if (pixels != size) {
            if (auto done = renderer->configure(pixels, graphics.render); !done) return done;
            size = pixels;
        }
        render::FrameInput frame{camera, world::environmentAt(static_cast<float>(session.clock.timeDay))};
        frame.fogDistance = view::fogDistance(view.visibleDistance());
        frame.timeSeconds = static_cast<float>(now);
        frame.waterAbove = game::waterAbove(session, camera.position);
        frame.maxShadowTiles = render::ShadowClipmap::kTilesPerFrame;
        renderer->draw(frame);
        renderer->presentToWindow(size);
        glfwSwapBuffers(window);
    }
    return session.save();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: small_game WORLD.sqlite\n"), 1;
    auto parts = openWorld(argv[1]);
    if (!parts) return std::fprintf(stderr, "%s\n", parts.error().message.c_str()), 1;
    GLFWwindow* window = openWindow();
    if (!window) return std::fprintf(stderr, "no window with OpenGL 4.5 can be opened\n"), 1;
    const auto played = play(window, std::move(*parts));  // frees all OpenGL objects
    glfwTerminate();
    if (!played) return std::fprintf(stderr, "%s\n", played.error().message.c_str()), 1;
}
