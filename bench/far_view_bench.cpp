// Land where tiles replace chunks: twenty views of 96 chunks (light of more than 97 does not fit), each
// compared with the same view with tiles of one level from the distance on where its ring begins.
//   bench_far_view [FOLDER [DISTANCE [PLACES]]]     96 chunks, 5 places; FOLDER gets the pictures, "" none
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <optional>
#include <string>

#include "bench/bench_content.h"
#include "bench/picture_figures.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/store/overlay_store.h"
#include "terrane/view/camera_path.h"
#include "terrane/view/world_view.h"

namespace {

using namespace terrane;
using world::ChunkPos;

constexpr glm::ivec2 kSize{640, 360};
constexpr int kDetail = 8, kTopLevel = 4;  // the coarsest; the ring of level 4 begins 64 chunks away
constexpr float kNoon = 0.5f, kDusk = 0.78f, kNight = 0.0f;
constexpr world::BlockPos kTown{-1024, 512, 84};

struct Place {
    const char* name;
    world::Pose pose;
    float otherYaw;  // of the fourth view
};
constexpr std::array kPlaces = {
    Place{"mountains", {{-1048, -108, 122}, 136, -6}, 40}, Place{"coast", {{196, -522, 120}, 0, -6}, 90},
    Place{"plains", {{1697, -392, 110}, 90, -6}, 200},     Place{"forest", {{-2546, 2220, 130}, 0, -8}, 200},
    Place{"town", {{-992, 96, 130}, 90, -8}, 60},
};

// Houses, lamps and a tower on a platform.
std::vector<game::EditCommand> villageAt(world::BlockPos corner) {
    std::vector<game::EditCommand> commands;
    const auto put = [&](int x, int y, int z, std::string_view name) {
        commands.push_back({game::kNoPlayer,
                            {corner.x + x, corner.y + y, corner.z + z},
                            world::SetBlock{bench::blockId(name)},
                            std::nullopt});
    };
    for (int k = 0; k < 64 * 64; ++k) {
        const int x = k % 64, y = k / 64;
        for (int z = -20; z <= 0; ++z) put(x, y, z, "stone");
        if (x % 16 == 0 && y % 16 == 0) put(x, y, 1, "lamp_red");
        const bool isHouse = x % 16 >= 4 && x % 16 < 12 && y % 16 >= 4 && y % 16 < 12;
        for (int z = 1; isHouse && z < 7; ++z) put(x, y, z, z < 5 ? "oak_log" : "sand");
    }
    for (int z = 1; z < 60; ++z) put(1, 1, z, "snow");
    return commands;
}

struct Stage {
    gen::LevelGenerators generators =
        bench::orExit(gen::makeLevelGenerators("overworld", bench::blocks(), 1));
    world::BlockRegistry farBlocks = bench::blocks().forFarTiles();
    gpu::ShaderLoader shaders = gpu::builtInShaders("");
    render::Renderer renderer = bench::orExit(
        render::Renderer::create(shaders, bench::blocks(), content::builtInTextures(), gpu::queryDevice()));
    std::optional<game::Session> session;
    std::optional<view::WorldView> view;
    ChunkPos center;
    int distance = 0;
};

void load(Stage& stage, const Place& place, int distance) {
    stage.view.reset();
    stage.session.reset();
    stage.renderer.clearChunks();
    game::SessionParts parts{std::make_unique<const world::BlockRegistry>(bench::blocks()),
                             bench::orExit(gen::makeLevelGenerators("overworld", bench::blocks(), 1)),
                             std::make_unique<store::MemoryStore>(store::WorldIdentity{1, "overworld", 1}),
                             2};
    parts.storesGenerated = false;
    stage.session.emplace(std::move(parts));
    stage.view.emplace(*stage.session, stage.renderer);
    stage.renderer.setViewDistance(distance);
    const render::Camera camera = view::cameraOf(place.pose);
    const auto loadAll = [&](const render::Camera& at, int radius) {
        view::loadAll(*stage.session, *stage.view, at, radius, std::chrono::steady_clock::now());
    };
    if (std::string_view(place.name) == "town") {
        stage.session->buildTiles();
        loadAll({{kTown.x, kTown.y, kTown.z}}, 6);
        stage.session->edit(villageAt(kTown));
        bench::orExit(stage.session->save());
    }
    loadAll(camera, distance);
    stage.center = render::cameraChunk(camera);
    stage.distance = distance;
}

bench::Pictures draw(Stage& stage, const render::Camera& camera, float time) {
    bench::Pictures pictures;
    const auto with = [&](int layers, render::View view) {
        render::RenderOptions options = render::findPreset("low", true)->options;
        options.transparencyLayers = layers;
        bench::orExit(stage.renderer.configure(kSize, options));
        stage.renderer.draw(
            {camera, world::environmentAt(time), 2 * view::fogDistance(stage.distance), 0, view});
        return stage.renderer.readImage();
    };
    pictures.color = with(1, render::View::Color);
    pictures.dry = with(0, render::View::Color);
    pictures.normal = with(0, render::View::Normal);
    return pictures;
}

// Distance where the ring of a level begins, chunks: see docs/levels.md.
int ringOf(int level) {
    return std::max(16, kDetail / 2 << level);
}

// Tiles of the level, from its ring on, that lie wholly within the view distance.
std::vector<ChunkPos> tilesOf(const Stage& stage, int level) {
    std::vector<ChunkPos> tiles;
    const int width = 1 << level, across = stage.distance / width + 1;
    for (int y = -across; y <= across; ++y) {
        for (int x = -across; x <= across; ++x) {
            const ChunkPos tile{(stage.center.x >> level) + x, (stage.center.y >> level) + y,
                                static_cast<std::uint8_t>(level)};
            const int x0 = tile.x * width - stage.center.x, y0 = tile.y * width - stage.center.y;
            const bool isWhole =
                std::min(x0, y0) >= -stage.distance && std::max(x0, y0) + width - 1 <= stage.distance;
            if (isWhole && stream::tileDistance(stage.center, tile) >= ringOf(level)) tiles.push_back(tile);
        }
    }
    return tiles;
}

// Shows the tiles, or the chunks under them.
void show(Stage& stage, const std::vector<ChunkPos>& tiles, bool isShown) {
    mesh::MeshScratch scratch;
    for (const ChunkPos tile : tiles) {
        if (isShown) {
            const store::LoadedChunk saved = stage.session->store().load(tile);
            const world::Chunk chunk = saved.chunk ? *saved.chunk : stage.generators.generate(tile);
            if (!stage.renderer.setChunk(tile, mesh::meshTile(chunk, stage.farBlocks, {}, scratch)))
                bench::orExit(base::fail("no room for a tile on the GPU"));
        } else {
            stage.renderer.removeChunk(tile);
        }
        const int width = 1 << tile.level;
        for (int k = 0; k < width * width; ++k)
            stage.renderer.setShown({tile.x * width + k % width, tile.y * width + k / width}, !isShown);
    }
}

struct Sum {
    double views = 0, mean = 0, worstMean = 0, percentile99 = 0, darkest = 1, brightest = 1;
    double waterInBoth = 0, waterInAny = 0, skyline = 0, skylineBeyondCell = 0;

    void add(const bench::PictureFigures& f) {
        views += 1;
        mean += f.meanDifference;
        worstMean = std::max(worstMean, f.meanDifference);
        percentile99 = std::max(percentile99, f.percentile99);
        darkest = std::min(darkest, f.brightness);
        brightest = std::max(brightest, f.brightness);
        waterInBoth += f.waterInBoth;
        waterInAny += f.waterInAny;
        skyline += f.skyline;
        skylineBeyondCell += f.skylineBeyondCell;
    }
};

void print(std::string_view name, std::string_view view, int level, const Sum& s) {
    fmt::print("{:10} {:6} {:5} {:10.2f} {:10.2f} {:8.2f}   {:.4f} to {:.4f} {:10.3f} {:12.2f} {:10.1f}\n",
               name, view, level, s.mean / s.views, s.worstMean, s.percentile99, s.darkest, s.brightest,
               s.waterInAny > 0 ? s.waterInBoth / s.waterInAny : 1.0, s.skyline / s.views,
               100 * s.skylineBeyondCell / s.views);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const std::filesystem::path folder = argc > 1 ? argv[1] : "";
    const int distance = argc > 2 ? std::atoi(argv[2]) : 96;
    const auto places = static_cast<std::size_t>(std::clamp(argc > 3 ? std::atoi(argv[3]) : 5, 1, 5));
    const auto context = bench::orExit(gpu::HeadlessContext::create({}));
    context.makeCurrent();
    Stage stage;
    std::array<Sum, kTopLevel + 1> sums;
    fmt::print(
        "place      view   level       mean  worst mean      99 %   brightness         water IoU  skyline, "
        "px  beyond a cell, %\n");
    for (std::size_t n = 0; n < places; ++n) {
        const Place& place = kPlaces[n];
        load(stage, place, distance);
        for (int k = 0; k < 4; ++k) {
            constexpr std::array kNames = {"noon", "dusk", "night", "other"};
            constexpr std::array kTimes = {kNoon, kDusk, kNight, kNoon};
            const auto at = static_cast<std::size_t>(k);
            render::Camera camera = view::cameraOf(place.pose);
            if (k == 3) camera.yaw = place.otherYaw;
            const bench::Pictures chunks = draw(stage, camera, kTimes[at]);
            for (int level = 1; level <= kTopLevel && ringOf(level) < distance; ++level) {
                const std::vector<ChunkPos> shown = tilesOf(stage, level);
                show(stage, shown, true);
                const bench::Pictures tiles = draw(stage, camera, kTimes[at]);
                show(stage, shown, false);
                const double focal = kSize.y / 2 / std::tan(glm::radians(camera.fieldOfView) / 2);
                const double cell = (1 << level) * focal / (ringOf(level) * world::kChunkSize);
                const bench::PictureFigures figures = comparePictures(chunks, tiles, cell);
                Sum one;
                one.add(figures);
                print(place.name, kNames[at], level, one);
                sums[static_cast<std::size_t>(level)].add(figures);
                if (folder.empty()) continue;
                const auto file = folder / fmt::format("{}_{}_{}.png", place.name, kNames[at], level);
                if (!base::writePng(file, bench::above(chunks.color, tiles.color))) return 1;
            }
        }
    }
    for (int level = 1; level <= kTopLevel && ringOf(level) < distance; ++level)
        print("all", "", level, sums[static_cast<std::size_t>(level)]);
    return 0;
}
