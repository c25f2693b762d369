// Land where tiles replace chunks: twenty views of a land, each compared with the same view with tiles of one
// level from the distance on where its ring begins.
//   bench_far_view [LAND [FOLDER [DISTANCE [PLACES]]]]
// LAND is overworld, wilderness or tall (examples/lua/generators/tall.lua). 96 chunks (light of more than 97
// does not fit), 5 places; FOLDER gets the pictures, "" none.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <optional>
#include <set>
#include <string>

#include "bench/bench_content.h"
#include "bench/picture_figures.h"
#include "bench/tall_land.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/store/overlay_store.h"
#include "terrane/stream/meshing.h"
#include "terrane/view/camera_path.h"
#include "terrane/view/world_view.h"

namespace {

using namespace terrane;
using world::ChunkPos;

constexpr glm::ivec2 kSize{640, 360};
constexpr int kDetail = 8, kTopLevel = 4;  // the coarsest; the ring of level 4 begins 64 chunks away

struct ViewKind {
    const char* name;
    float time;
};
// The last one looks elsewhere.
constexpr std::array kViews = {ViewKind{"noon", 0.5f}, ViewKind{"dusk", 0.78f}, ViewKind{"night", 0},
                               ViewKind{"other", 0.5f}};
constexpr world::BlockPos kTown{-1024, 512, 84};

struct Place {
    const char *land, *name;
    glm::dvec2 at;
    double above;  // the highest block there
    float yaw, pitch;
    float otherYaw;  // of the fourth view
};
constexpr std::array kPlaces = {
    Place{"overworld", "mountains", {-1048, -108}, 30, 136, -6, 40},
    Place{"overworld", "coast", {196, -522}, 30, 0, -6, 90},
    Place{"overworld", "plains", {1697, -392}, 30, 90, -6, 200},
    Place{"overworld", "forest", {-2546, 2220}, 30, 0, -8, 200},
    Place{"overworld", "town", {-992, 96}, 30, 90, -8, 60},
    Place{"wilderness", "range", {1322, 773}, 120, 70, -8, 250},
    Place{"wilderness", "canyon", {2930, 2866}, 60, 0, -8, 90},
    Place{"wilderness", "karst", {-2709, 2467}, 60, 90, -6, 40},
    Place{"wilderness", "volcano", {-290, 774}, 60, 220, 2, 120},
    Place{"wilderness", "snow", {4300, -5800}, 100, 60, -6, 300},
    Place{"tall", "islands", {-1527, 715}, 60, 315, 12, 180},
    Place{"tall", "foot", {-390, -1500}, 60, 350, 8, 250},
    Place{"tall", "peak", {1700, -1900}, 60, 60, -6, 200},
    Place{"tall", "shade", {760, 900}, 60, 90, -4, 180},
    Place{"tall", "plateau", {-1500, 715}, 100, 0, 0, 270},
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

gen::LevelGenerators generatorsOf(std::string_view land) {
    if (land == "tall") return {bench::recordTallLand(bench::blocks()), 1, bench::kTallHeights};
    return bench::orExit(gen::makeLevelGenerators(land, bench::blocks(), 1));
}

struct Stage {
    explicit Stage(std::string_view land) : generators(generatorsOf(land)) {}

    gen::LevelGenerators generators;
    world::BlockRegistry farBlocks = bench::blocks().forFarTiles();
    gpu::ShaderLoader shaders = gpu::builtInShaders("");
    render::Renderer renderer = bench::orExit(
        render::Renderer::create(shaders, bench::blocks(), content::builtInTextures(), gpu::queryDevice()));
    std::optional<game::Session> session;
    std::optional<view::WorldView> view;
    ChunkPos center;
    int distance = 0;
};

render::Camera cameraAt(const Stage& stage, const Place& place) {
    const world::BlockPos at{static_cast<int>(place.at.x), static_cast<int>(place.at.y), 0};
    const world::Chunk chunk = stage.generators.generate(world::chunkOf(at));
    int z = chunk.heights().top - 1;
    while (z > chunk.heights().bottom &&
           chunk.block(world::blockIndex(at.x & 15, at.y & 15, z)) == world::kAir)
        --z;
    return {{place.at, z + place.above}, place.yaw, place.pitch};
}

void load(Stage& stage, const Place& place, const render::Camera& camera, int distance) {
    stage.view.reset();
    stage.session.reset();
    stage.renderer.clearChunks();
    game::SessionParts parts{std::make_unique<const world::BlockRegistry>(bench::blocks()),
                             generatorsOf(place.land),
                             std::make_unique<store::MemoryStore>(
                                 store::WorldIdentity{1, place.land, 1, stage.generators.heights()}),
                             2};
    parts.storesGenerated = false;
    stage.session.emplace(std::move(parts));
    stage.view.emplace(*stage.session, stage.renderer);
    stage.renderer.setViewDistance(distance);
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

// Tiles of the level, from its ring on, that lie wholly within the view distance, but not at its border: the
// sides of the land that is loaded are the same in both images.
std::vector<ChunkPos> tilesOf(const Stage& stage, int level) {
    std::vector<ChunkPos> tiles;
    const int width = 1 << level, across = stage.distance / width + 1;
    for (int y = -across; y <= across; ++y) {
        for (int x = -across; x <= across; ++x) {
            const ChunkPos tile{(stage.center.x >> level) + x, (stage.center.y >> level) + y,
                                static_cast<std::uint8_t>(level)};
            const int x0 = tile.x * width - stage.center.x, y0 = tile.y * width - stage.center.y;
            const bool isWhole =
                std::min(x0, y0) > -stage.distance && std::max(x0, y0) + width - 1 < stage.distance;
            if (isWhole && stream::tileDistance(stage.center, tile) >= ringOf(level)) tiles.push_back(tile);
        }
    }
    return tiles;
}

// The chunks under some tiles.
std::set<ChunkPos> chunksUnder(const std::vector<ChunkPos>& tiles) {
    std::set<ChunkPos> chunks;
    for (const ChunkPos tile : tiles) {
        const int width = 1 << tile.level;
        for (int k = 0; k < width * width; ++k)
            chunks.insert({tile.x * width + k % width, tile.y * width + k / width});
    }
    return chunks;
}

// Meshes the chunks beside those that are gone again: their sides there are open, as beside tiles.
void meshAround(Stage& stage, const std::set<ChunkPos>& gone, mesh::MeshScratch& scratch) {
    constexpr std::array<std::pair<int, int>, 4> kSides = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    const world::ChunkPtr open = stream::borderChunk(bench::blocks(), stage.generators.heights());
    std::set<ChunkPos> around;
    for (const ChunkPos pos : gone) {
        for (const auto& [x, y] : kSides) {
            const ChunkPos beside = world::offsetBy(pos, x, y);
            if (!gone.contains(beside)) around.insert(beside);
        }
    }
    const auto& chunks = stage.session->world();
    for (const ChunkPos pos : around) {
        mesh::MeshBlocks blocks{chunks.maybeChunkAt(pos)};
        for (std::size_t side = 0; side < kSides.size(); ++side) {
            const ChunkPos beside = world::offsetBy(pos, kSides[side].first, kSides[side].second);
            blocks[side + 1] = gone.contains(beside) ? open : chunks.maybeChunkAt(beside);
        }
        const mesh::MeshInput input = mesh::meshInput(blocks, bench::blocks(), {});
        if (!stage.renderer.setChunk(pos, mesh::meshChunk(input, scratch)))
            bench::orExit(base::fail("no room for a chunk on the GPU"));
    }
}

// Replaces chunks by tiles.
void replaceBy(const std::vector<ChunkPos>& tiles, Stage& stage) {
    mesh::MeshScratch scratch;
    const std::set<ChunkPos> gone = chunksUnder(tiles);
    for (const ChunkPos pos : gone) stage.renderer.removeChunk(pos);
    meshAround(stage, gone, scratch);
    for (const ChunkPos tile : tiles) {
        const store::LoadedChunk saved = stage.session->store().load(tile);
        const world::Chunk chunk = saved.chunk ? *saved.chunk : stage.generators.generate(tile);
        if (!stage.renderer.setChunk(tile, mesh::meshTile(chunk, stage.farBlocks, {}, scratch)))
            bench::orExit(base::fail("no room for a tile on the GPU"));
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
    const std::string_view land = argc > 1 ? argv[1] : "overworld";
    const std::filesystem::path folder = argc > 2 ? argv[2] : "";
    const int distance = argc > 3 ? std::atoi(argv[3]) : 96;
    int places = argc > 4 ? std::atoi(argv[4]) : 5;
    const auto context = bench::orExit(gpu::HeadlessContext::create({}));
    context.makeCurrent();
    Stage stage(land);
    std::array<Sum, kTopLevel + 1> sums;
    fmt::print(
        "place      view   level       mean  worst mean      99 %   brightness         water IoU  skyline, "
        "px  beyond a cell, %\n");
    for (const Place& place : kPlaces) {
        if (place.land != land || places-- <= 0) continue;
        const render::Camera first = cameraAt(stage, place);
        load(stage, place, first, distance);
        std::array<render::Camera, kViews.size()> cameras;
        cameras.fill(first);
        cameras.back().yaw = place.otherYaw;
        std::array<bench::Pictures, kViews.size()> chunks;
        for (std::size_t k = 0; k < kViews.size(); ++k) chunks[k] = draw(stage, cameras[k], kViews[k].time);
        // A finer level replaces the chunks of all coarser ones and more.
        for (int level = kTopLevel; level >= 1; --level) {
            if (ringOf(level) >= distance) continue;
            const std::vector<ChunkPos> shown = tilesOf(stage, level);
            replaceBy(shown, stage);
            const double focal = kSize.y / 2 / std::tan(glm::radians(first.fieldOfView) / 2);
            const double cell = (1 << level) * focal / (ringOf(level) * world::kChunkSize);
            for (std::size_t k = 0; k < kViews.size(); ++k) {
                const bench::Pictures tiles = draw(stage, cameras[k], kViews[k].time);
                const bench::PictureFigures figures = comparePictures(chunks[k], tiles, cell);
                Sum one;
                one.add(figures);
                print(place.name, kViews[k].name, level, one);
                sums[static_cast<std::size_t>(level)].add(figures);
                if (folder.empty()) continue;
                const auto file = folder / fmt::format("{}_{}_{}.png", place.name, kViews[k].name, level);
                if (!base::writePng(file, bench::above(chunks[k].color, tiles.color))) return 1;
            }
            for (const ChunkPos tile : shown) stage.renderer.removeChunk(tile);
        }
    }
    for (int level = 1; level <= kTopLevel && ringOf(level) < distance; ++level)
        print("all", "", level, sums[static_cast<std::size_t>(level)]);
    return 0;
}
