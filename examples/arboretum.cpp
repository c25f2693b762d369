// Draws one of each kind of tree, bush and stone on flat ground into a PNG file, one strip for each climate,
// all at one scale: a complete path from a generator with stamps to an image. docs/worldgen.md shows the
// result and the table that it prints.
//
//     arboretum IMAGE.png [VARIANT]
//     arboretum --table
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrane/content/built_in.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/generators/trees/trees.h"
#include "terrane/gen/language/builder.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/light/light_area.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/render/frame/renderer.h"

namespace {

using namespace terrane;
using gen::trees::Kind;

constexpr int kGround = 80;  // height of the grass
// Chunks to draw: kAcross to both sides, and from kFront to kBack away from the camera. One more is lit
// around them.
constexpr int kAcross = 6, kFront = -4, kBack = 7;
constexpr int kBackRow = 26;  // y of the high ones
constexpr int kWide = 2 * kAcross + 3, kDeep = kBack - kFront + 3;

// All strips at the same scale. Of the drawn image a strip keeps the lowest rows.
constexpr int kImageWidth = 900, kImageHeight = 470;

struct Strip {
    int rows;  // pixels
    std::vector<Kind> back, front;
};

const std::vector<Strip>& strips() {
    static const std::vector<Strip> all = {
        {kImageHeight,
         {Kind::Spruce, Kind::Larch, Kind::Fir, Kind::Sequoia, Kind::Pine, Kind::Snag, Kind::DeadTree},
         {Kind::YoungSpruce, Kind::YoungFir, Kind::Krummholz, Kind::Boulder, Kind::UprootedTree}},
        {314,
         {Kind::Beech, Kind::Birch, Kind::OldOak, Kind::Maple, Kind::Poplar, Kind::Aspen, Kind::Willow},
         {Kind::YoungBirch, Kind::YoungOak, Kind::Oak, Kind::Hazel, Kind::Bush, Kind::Cherry, Kind::Stump}},
        {352,
         {Kind::Cypress, Kind::StonePine, Kind::Cedar, Kind::Eucalyptus, Kind::Baobab, Kind::Acacia},
         {Kind::Olive, Kind::Juniper, Kind::DryShrub, Kind::JoshuaTree}},
        {kImageHeight,
         {Kind::Palm, Kind::Kapok, Kind::Fig, Kind::Bamboo, Kind::GiantMushroom},
         {Kind::TreeFern, Kind::DwarfPalm, Kind::Mangrove, Kind::Thicket, Kind::FallenLog}},
    };
    return all;
}

struct Place {
    int shape, x, y;
};

// Puts kinds beside each other, centered at x = 0, as far apart as the drawn variants are wide.
void placeRow(std::vector<Place>& places, const std::vector<Kind>& row, const gen::trees::TreeKinds& kinds,
              std::pair<int, int> variantAndY) {
    const auto [variant, y] = variantAndY;
    constexpr int kGap = 5;
    const std::size_t first = places.size();
    int right = 0;
    for (const Kind kind : row) {
        const auto& shapes = gen::trees::shapesOf(kind);
        const std::size_t number = static_cast<std::size_t>(variant) % shapes.size();
        int low = 0, high = 0;
        for (const gen::ShapeVoxel& v : shapes[number].voxels) {
            low = std::min<int>(low, v.x);
            high = std::max<int>(high, v.x);
        }
        places.push_back({gen::trees::of(kinds, kind).first + static_cast<int>(number), right - low, y});
        right += high - low + kGap;
    }
    for (std::size_t k = first; k < places.size(); ++k) places[k].x -= (right - kGap) / 2;
}

void writeArboretum(gen::GeneratorBuilder& g, const Strip& strip, int variant) {
    using namespace gen;
    std::vector<Kind> grown = strip.back;
    grown.insert(grown.end(), strip.front.begin(), strip.front.end());
    const trees::TreeKinds kinds = trees::record(g, grown);
    std::vector<Place> places;
    placeRow(places, strip.back, kinds, {variant, kBackRow});
    placeRow(places, strip.front, kinds, {variant, -40});
    const auto shape = g.field<Int>("shape"), base = g.field<Int>("base");
    g.pass2D("feet", [&](Pass& p) {
        Int here = -1;
        for (const Place& place : places)
            here = select(p.x() == place.x && p.y() == place.y, Int(place.shape), here);
        p.set(shape, here);
        p.set(base, Int(kGround + 1));
    });
    g.pass3D("land", [&](Pass& p) {
        const Block ground = select(p.z() == kGround, p.block("grass"), p.block("dirt"));
        const Block stamped = p.stamp(shape, base);
        p.setBlock(select(p.z() <= kGround && stamped == p.block("air"), ground, stamped));
    });
}

world::ChunkPos posOf(int k) {
    return {k % kWide - kAcross - 1, k / kWide + kFront - 1};
}

// Lights all chunks and meshes those that have all neighbors.
void show(const gen::Generator& generator, const world::BlockRegistry& blocks, render::Renderer& renderer) {
    std::vector<world::Chunk> chunks;
    for (int k = 0; k < kWide * kDeep; ++k) chunks.push_back(generator.generate(posOf(k)));
    light::LightArea area{kWide, kDeep, {}};
    for (const world::Chunk& chunk : chunks) area.chunks.push_back(&chunk);
    const auto lights = light::lightArea(area, light::LightTable(blocks));
    mesh::MeshScratch scratch;
    for (int k = 0; k < kWide * kDeep; ++k) {
        const world::ChunkPos pos = posOf(k);
        if (std::abs(pos.x) > kAcross || pos.y < kFront || pos.y > kBack) continue;
        const auto beside = [&](int step) { return area.chunks[static_cast<std::size_t>(k + step)]; };
        const mesh::MeshInput input{
            beside(0), {beside(-1), beside(1), beside(-kWide), beside(kWide)}, &blocks, {}};
        renderer.setChunk(pos, mesh::meshChunk(input, scratch));
        renderer.setLight(pos, lights[static_cast<std::size_t>(k)]);
    }
}

void draw(render::Renderer& renderer, base::Image& image, int rows) {
    render::FrameInput input{{{0.5, -170.0, kGround + 36.0}, 90, -6.5f, 20}, world::environmentAt(0.42f)};
    input.fogDistance = 900;
    renderer.draw(input);
    const base::Image drawn = renderer.readImage();
    const auto kept = static_cast<std::ptrdiff_t>(rows) * kImageWidth * 4;
    image.height += rows;
    image.rgba.insert(image.rgba.end(), drawn.rgba.end() - kept, drawn.rgba.end());
}

base::Result<void> run(const std::string& file, int variant) {
    auto blocks = content::loadBlocks();
    if (!blocks) return tl::unexpected(blocks.error());
    auto context = gpu::HeadlessContext::create({.debug = true});
    if (!context) return tl::unexpected(context.error());
    const gpu::ShaderLoader shaders = gpu::builtInShaders("");
    auto renderer =
        render::Renderer::create(shaders, *blocks, content::builtInTextures(), gpu::queryDevice());
    if (!renderer) return tl::unexpected(renderer.error());
    renderer->setViewDistance(3 * kWide);
    render::RenderOptions options;
    options.msaaSamples = 4;
    options.depthOfField = options.godRays = false;
    if (auto done = renderer->configure({kImageWidth, kImageHeight}, options); !done) return done;
    base::Image image{kImageWidth, 0, {}};
    for (const Strip& strip : strips()) {
        gen::GeneratorBuilder builder("arboretum", *blocks);
        writeArboretum(builder, strip, variant);
        auto graph = builder.finish();
        if (!graph) return tl::unexpected(graph.error());
        show(gen::Generator(std::move(*graph), 1), *blocks, *renderer);
        draw(*renderer, image, strip.rows);
    }
    return base::writePng(file, image);
}

// The table of docs/worldgen.md: two kinds a row, the second half beside the first. And how long kinds grow.
base::Result<void> printTable() {
    auto blocks = content::loadBlocks();
    if (!blocks) return tl::unexpected(blocks.error());
    const auto start = std::chrono::steady_clock::now();
    for (const Kind kind : gen::trees::allKinds()) gen::trees::shapesOf(kind);
    const std::chrono::duration<double, std::milli> growth = std::chrono::steady_clock::now() - start;
    std::fprintf(stderr, "grown in %.0f ms\n", growth.count());
    gen::GeneratorBuilder builder("table", *blocks);
    const gen::trees::TreeKinds kinds = gen::trees::record(builder);
    const std::size_t rows = (kinds.size() + 1) / 2;
    std::puts("| kind | shapes | blocks from above | height | kind | shapes | blocks from above | height |");
    std::puts("|---|---|---|---|---|---|---|---|");
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t k = row; k < kinds.size(); k += rows) {
            std::printf("| %.*s | %d | %.0f | %.0f ", static_cast<int>(kinds[k].name.size()),
                        kinds[k].name.data(), kinds[k].count, static_cast<double>(kinds[k].cover),
                        static_cast<double>(kinds[k].height));
        }
        std::puts("|");
    }
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2 && argc != 3) {
        std::fprintf(stderr, "usage: arboretum IMAGE.png [VARIANT], or arboretum --table\n");
        return 2;
    }
    const bool isTable = std::string_view(argv[1]) == "--table";
    const auto done = isTable ? printTable() : run(argv[1], argc == 3 ? std::atoi(argv[2]) : 0);
    if (!done) {
        std::fprintf(stderr, "%s\n", done.error().message.c_str());
        return 2;
    }
    return 0;
}
