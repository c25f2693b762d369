// Cameras anywhere in a tall world: images compared with rays through the blocks that they show.
//   bench_holes [CAMERAS [SEED [FOLDER [VIEW HORIZON DETAIL [FIRST]]]]]
//   bench_holes 1 SEED FOLDER X Y Z YAW PITCH [VIEW HORIZON DETAIL]     one camera again
// 1000 cameras, seed 1, 6 chunks, 512 chunks, 12, from camera 0 on (a multiple of 20); FOLDER gets images
// with holes, "" none.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "bench/bench_content.h"
#include "bench/hole_finder.h"
#include "bench/tall_land.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/store/overlay_store.h"
#include "terrane/view/world_view.h"

namespace {

using namespace terrane;
using world::ChunkPos;

constexpr glm::ivec2 kSize{160, 90};
constexpr int kNear = 6;              // chunks
constexpr int kCamerasOfAPlace = 20;  // within kReach chunks
constexpr int kReach = 4, kWorld = 4000;

void markHoles(base::Image& image, const std::vector<bench::Hole>& where) {
    for (const auto& [at, drawn, ground, groundAt] : where) {
        const std::size_t k = 4 * static_cast<std::size_t>(at.x + at.y * image.width);
        image.rgba[k] = image.rgba[k + 2] = 255;
        image.rgba[k + 1] = 0;
    }
}

struct Stage {
    Stage(unsigned seed, int near, const view::Horizon& horizon) : nearChunks(near) {
        game::SessionParts parts{
            std::make_shared<const world::BlockRegistry>(bench::blocks()),
            gen::LevelGenerators(bench::recordTallLand(bench::blocks()), seed, bench::kTallHeights),
            std::make_unique<store::MemoryStore>(store::WorldIdentity{1, "tall", 1, bench::kTallHeights}), 2};
        parts.storesGenerated = false;
        session.emplace(std::move(parts));
        view.emplace(*session, renderer);
        blocks.emplace(*session);
        render::RenderOptions options = render::findPreset("low", true)->options;
        options.distanceFog = false;
        bench::orExit(renderer.configure(kSize, options));
        renderer.setViewDistance(near);
        view->setHorizon(horizon);
    }

    gpu::ShaderLoader shaders = gpu::builtInShaders("");
    render::Renderer renderer = bench::orExit(
        render::Renderer::create(shaders, bench::blocks(), content::builtInTextures(), gpu::queryDevice()));
    std::optional<game::Session> session;
    std::optional<view::WorldView> view;
    std::optional<bench::ShownBlocks> blocks;
    int nearChunks;
};

// Prints and draws holes of one camera.
bench::HoleCount look(Stage& stage, const render::Camera& camera, int number,
                      const std::filesystem::path& folder) {
    view::loadAll(*stage.session, *stage.view, camera, stage.nearChunks, std::chrono::steady_clock::now());
    const bench::HoleCount found = bench::findHoles(stage.renderer, *stage.blocks, camera);
    if (found.where.empty()) return found;
    const bench::Hole& first = found.where[0];
    fmt::print(
        "camera {}: {} holes, {} walls at {} {} {} {} {}; first at pixel {},{}: {:.1f} blocks, ground {:.1f} "
        "at "
        "{:.1f},{:.1f},{:.1f}\n",
        number, found.holes, found.walls, camera.position.x, camera.position.y, camera.position.z, camera.yaw,
        camera.pitch, first.pixel.x, first.pixel.y, first.drawn, first.ground, first.groundAt.x,
        first.groundAt.y, first.groundAt.z);
    std::fflush(stdout);
    if (folder.empty()) return found;
    stage.renderer.draw({camera, world::environmentAt(0.5f), 1e6f, 0, render::View::Color});
    base::Image image = stage.renderer.readImage();
    bench::orExit(base::writePng(folder / fmt::format("{}.png", number), image));
    markHoles(image, found.where);
    bench::orExit(base::writePng(folder / fmt::format("{}_marked.png", number), image));
    return found;
}

struct Cameras {
    int first = 0, count = 1000;
    unsigned seed = 1;
};

bench::HoleCount lookAnywhere(Stage& stage, const Cameras& cameras, const std::filesystem::path& folder) {
    std::mt19937 random;
    const auto chunkWithin = [&](int reach) {
        return std::uniform_int_distribution<int>(-reach, reach)(random);
    };
    bench::HoleCount sum;
    ChunkPos place;
    for (int n = cameras.first; n < cameras.first + cameras.count; ++n) {
        if (n % kCamerasOfAPlace == 0) {
            random.seed(cameras.seed * 10'000 + static_cast<unsigned>(n / kCamerasOfAPlace));
            place = {chunkWithin(kWorld), chunkWithin(kWorld)};
            stage.blocks->forget();
        }
        const ChunkPos pos = world::offsetBy(place, chunkWithin(kReach), chunkWithin(kReach));
        sum += look(stage, bench::randomCamera(stage.blocks->whole(pos), pos, bench::blocks(), random), n,
                    folder);
    }
    return sum;
}

}  // namespace

int main(int argc, char** argv) {
    const auto numberAt = [&](int n, double otherwise) { return n < argc ? std::atof(argv[n]) : otherwise; };
    const int cameras = static_cast<int>(numberAt(1, 1000));
    const auto seed = static_cast<unsigned>(numberAt(2, 1));
    const std::filesystem::path folder = argc > 3 ? argv[3] : "";
    const auto context = bench::orExit(gpu::HeadlessContext::create({}));
    context.makeCurrent();
    const bool isOne = argc >= 9;
    Stage stage(
        seed, static_cast<int>(numberAt(isOne ? 9 : 4, 6)),
        {static_cast<int>(numberAt(isOne ? 10 : 5, 512)), static_cast<int>(numberAt(isOne ? 11 : 6, 12))});
    bench::HoleCount sum;
    if (isOne) {
        sum = look(stage,
                   {{numberAt(4, 0), numberAt(5, 0), numberAt(6, 0)},
                    static_cast<float>(numberAt(7, 0)),
                    static_cast<float>(numberAt(8, 0))},
                   0, folder);
    } else {
        sum = lookAnywhere(stage, {static_cast<int>(numberAt(7, 0)), cameras, seed}, folder);
    }
    fmt::print("{} pixels of ground, {} holes, {} walls, {} of ground that is not made\n", sum.pixels,
               sum.holes, sum.walls, sum.closed);
    return sum.holes + sum.walls > 0;
}
