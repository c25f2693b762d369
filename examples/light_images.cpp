// Draws the light scenes, classic and smooth side by side, into PNG files; or measures frames with few and
// many lamps. Everything goes through the library; tools/light_images.sh calls it for docs/light.md.
//
//     light_images FOLDER
//     light_images --lamps
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <span>
#include <string>

#include "examples/light_scenes.h"
#include "terrane/content/built_in.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/light/light_area.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/render/frame/renderer.h"
#include "terrane/shared/constants.h"

namespace {

using namespace terrane;
using examples::kSceneRadius;

constexpr int kSide = 2 * kSceneRadius + 3;  // chunks, with an empty border that is not drawn

world::ChunkPos posOf(int k) {
    return {k % kSide - kSceneRadius - 1, k / kSide - kSceneRadius - 1};
}

world::World emptyWorld() {
    world::World world;
    for (int k = 0; k < kSide * kSide; ++k) world.insert(posOf(k), std::make_shared<world::Chunk>());
    return world;
}

// Lights all chunks and meshes those that have all neighbors.
void show(const world::World& world, const world::BlockRegistry& blocks, render::Renderer& renderer) {
    light::LightArea area{kSide, kSide, {}};
    for (int k = 0; k < kSide * kSide; ++k) area.chunks.push_back(world.maybeChunkAt(posOf(k)).get());
    const auto lights = light::lightArea(area, light::LightTable(blocks));
    mesh::MeshScratch scratch;
    for (int k = 0; k < kSide * kSide; ++k) {
        const world::ChunkPos pos = posOf(k);
        if (std::max(std::abs(pos.x), std::abs(pos.y)) > kSceneRadius) continue;
        const auto beside = [&](int dx, int dy) {
            return world.maybeChunkAt({pos.x + dx, pos.y + dy}).get();
        };
        const mesh::MeshInput input{area.chunks[static_cast<std::size_t>(k)],
                                    {beside(-1, 0), beside(1, 0), beside(0, -1), beside(0, 1)},
                                    &blocks,
                                    {}};
        renderer.setChunk(pos, mesh::meshChunk(input, scratch));
        renderer.setLight(pos, lights[static_cast<std::size_t>(k)]);
    }
}

// Only light and shadows, which the two ways of sampling affect.
base::Result<void> configure(render::Renderer& renderer, render::LightSampling sampling) {
    render::RenderOptions options;
    options.msaaSamples = 4;
    options.light = sampling;
    options.depthOfField = options.godRays = false;
    return renderer.configure({384, 288}, options);
}

render::FrameInput frameOf(const examples::LightScene& scene) {
    render::FrameInput input{scene.camera, world::environmentAt(scene.timeDay)};
    input.fogDistance = 400;
    return input;
}

base::Image beside(const base::Image& left, const base::Image& right) {
    base::Image both{left.width + right.width, left.height, {}};
    for (int y = 0; y < left.height; ++y) {
        for (const base::Image* image : {&left, &right}) {
            const auto row = image->rgba.begin() + 4l * y * image->width;
            both.rgba.insert(both.rgba.end(), row, row + 4l * image->width);
        }
    }
    return both;
}

base::Result<void> drawScenes(const std::string& folder, const world::BlockRegistry& blocks,
                              const std::function<base::Result<render::Renderer>()>& makeRenderer) {
    for (const examples::LightScene& scene : examples::lightScenes()) {
        auto renderer = makeRenderer();
        if (!renderer) return tl::unexpected(renderer.error());
        world::World world = emptyWorld();
        scene.build(world, blocks);
        show(world, blocks, *renderer);
        if (auto done = configure(*renderer, render::LightSampling::Classic); !done) return done;
        renderer->draw(frameOf(scene));
        const base::Image classic = renderer->readImage();
        if (auto done = configure(*renderer, render::LightSampling::Smooth); !done) return done;
        renderer->draw(frameOf(scene));
        const auto written =
            base::writePng(folder + "/light_" + scene.name + ".png", beside(classic, renderer->readImage()));
        if (!written) return written;
    }
    return {};
}

// The fastest of some frames in milliseconds; 0 if the renderer cannot be configured.
double frameTime(render::Renderer& renderer, const render::FrameInput& input,
                 render::LightSampling sampling) {
    if (!configure(renderer, sampling)) return 0;
    double least = 1e9;
    for (int k = 0; k < 12; ++k) {
        const auto start = std::chrono::steady_clock::now();
        renderer.draw(input);
        (void)renderer.readImage();
        const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - start;
        least = std::min(least, passed.count());
    }
    return least;
}

base::Result<void> measureLamps(const world::BlockRegistry& blocks,
                                const std::function<base::Result<render::Renderer>()>& makeRenderer) {
    const examples::LightScene scene{"lamps", nullptr, {{-20.5, -30.5, 92.0}, 55, -20}, 0.0f};
    constexpr int kPlaces = 10'000;  // the same number of blocks in all scenes
    for (const int count : {1, 100, kPlaces}) {
        auto renderer = makeRenderer();
        if (!renderer) return tl::unexpected(renderer.error());
        world::World world = emptyWorld();
        examples::buildLamps(world, blocks, {count, kPlaces});
        show(world, blocks, *renderer);
        std::printf("%6d lamps: classic %.1f ms, smooth %.1f ms a frame; light %.1f KB a chunk\n", count,
                    frameTime(*renderer, frameOf(scene), render::LightSampling::Classic),
                    frameTime(*renderer, frameOf(scene), render::LightSampling::Smooth),
                    static_cast<double>(renderer->lightBytes()) / 1e3 / ((kSide - 2) * (kSide - 2)));
    }
    return {};
}

base::Result<void> run(const std::string& argument) {
    auto blocks = content::loadBlocks();
    if (!blocks) return tl::unexpected(blocks.error());
    auto context = gpu::HeadlessContext::create({.debug = true});
    if (!context) return tl::unexpected(context.error());
    const gpu::ShaderLoader shaders = gpu::builtInShaders("");
    const auto makeRenderer = [&]() -> base::Result<render::Renderer> {
        auto renderer =
            render::Renderer::create(shaders, *blocks, content::builtInTextures(), gpu::queryDevice());
        if (!renderer) return renderer;
        renderer->setViewDistance(kSceneRadius);
        return renderer;
    };
    return argument == "--lamps" ? measureLamps(*blocks, makeRenderer)
                                 : drawScenes(argument, *blocks, makeRenderer);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: light_images FOLDER | --lamps\n");
        return 2;
    }
    if (const auto done = run(argv[1]); !done) {
        std::fprintf(stderr, "%s\n", done.error().message.c_str());
        return 2;
    }
    return 0;
}
