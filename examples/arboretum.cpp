// Draws one of each kind of tree, bush and stone on flat ground into a PNG file: a generator that stamps,
// from its feet to the image. docs/worldgen.md shows the result.
//
//     arboretum IMAGE.png [VARIANT]
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "terrane/content/built_in.h"
#include "terrane/gen/builder.h"
#include "terrane/gen/generator.h"
#include "terrane/gen/generators/trees/trees.h"
#include "terrane/gpu/built_in_shaders.h"
#include "terrane/gpu/context.h"
#include "terrane/light/light_area.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/render/renderer.h"

namespace {

using namespace terrane;
using gen::trees::Kind;

constexpr int kGround = 80;  // height of the grass
constexpr int kRadius = 4;   // chunks that are drawn
constexpr int kSide = 2 * kRadius + 3;

struct Place {
    Kind kind;
    int x, y;
};

// Three rows, the highest behind.
constexpr Place kPlaces[] = {
    {Kind::Spruce, -45, 20}, {Kind::Larch, -34, 23},  {Kind::Pine, -23, 20},    {Kind::OldOak, 0, 26},
    {Kind::Cypress, 21, 20}, {Kind::Baobab, 32, 21},  {Kind::Palm, 45, 19},     {Kind::Birch, -38, 6},
    {Kind::Oak, -26, 4},     {Kind::DeadTree, 19, 5}, {Kind::Willow, -12, 7},   {Kind::Acacia, 33, 4},
    {Kind::Bush, -20, -7},   {Kind::Boulder, -9, -6}, {Kind::FallenLog, 4, -5}, {Kind::GiantMushroom, 9, 5},
};

void writeArboretum(gen::GeneratorBuilder& g, int variant) {
    using namespace gen;
    const trees::TreeKinds kinds = trees::record(g);
    const auto shape = g.field<Int>("shape"), base = g.field<Int>("base");
    g.pass2D("feet", [&](Pass& p) {
        Int here = -1;
        for (const Place& place : kPlaces) {
            const trees::KindRecord& kind = trees::of(kinds, place.kind);
            here = select(p.x() == place.x && p.y() == place.y, Int(kind.first + variant % kind.count), here);
        }
        p.set(shape, here);
        p.set(base, Int(kGround + 1));
    });
    g.pass3D("land", [&](Pass& p) {
        const Block ground = select(p.z() == kGround, p.block("grass"), p.block("dirt"));
        p.setBlock(select(p.z() <= kGround, ground, p.stamp(shape, base)));
    });
}

world::ChunkPos posOf(int k) {
    return {k % kSide - kRadius - 1, k / kSide - kRadius - 1};
}

// Lights all chunks, meshes those that have neighbors.
void show(const gen::Generator& generator, const world::BlockRegistry& blocks, render::Renderer& renderer) {
    std::vector<world::Chunk> chunks;
    for (int k = 0; k < kSide * kSide; ++k) chunks.push_back(generator.generate(posOf(k)));
    light::LightArea area{kSide, kSide, {}};
    for (const world::Chunk& chunk : chunks) area.chunks.push_back(&chunk);
    const auto lights = light::lightArea(area, light::LightTable(blocks));
    mesh::MeshScratch scratch;
    for (int k = 0; k < kSide * kSide; ++k) {
        const world::ChunkPos pos = posOf(k);
        if (std::max(std::abs(pos.x), std::abs(pos.y)) > kRadius) continue;
        const auto beside = [&](int step) { return area.chunks[static_cast<std::size_t>(k + step)]; };
        const mesh::MeshInput input{
            beside(0), {beside(-1), beside(1), beside(-kSide), beside(kSide)}, &blocks, {}};
        renderer.setChunk(pos, mesh::meshChunk(input, scratch));
        renderer.setLight(pos, lights[static_cast<std::size_t>(k)]);
    }
}

base::Result<void> run(const std::string& file, int variant) {
    auto blocks = content::loadBlocks();
    if (!blocks) return tl::unexpected(blocks.error());
    gen::GeneratorBuilder builder("arboretum", *blocks);
    writeArboretum(builder, variant);
    auto graph = builder.finish();
    if (!graph) return tl::unexpected(graph.error());
    auto context = gpu::HeadlessContext::create({.debug = true});
    if (!context) return tl::unexpected(context.error());
    const gpu::ShaderLoader shaders = gpu::builtInShaders("");
    auto renderer =
        render::Renderer::create(shaders, *blocks, content::builtInTextures(), gpu::queryDevice());
    if (!renderer) return tl::unexpected(renderer.error());
    renderer->setViewDistance(kRadius);
    show(gen::Generator(std::move(*graph), 1), *blocks, *renderer);
    render::RenderOptions options;
    options.msaaSamples = 4;
    options.depthOfField = options.godRays = false;
    if (auto done = renderer->configure({1040, 360}, options); !done) return done;
    render::FrameInput input{{{0.5, -42.0, 98.0}, 90, -9, 34}, world::environmentAt(0.06f)};
    input.fogDistance = 400;
    renderer->draw(input);
    return base::writePng(file, renderer->readImage());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2 && argc != 3) {
        std::fprintf(stderr, "usage: arboretum IMAGE.png [VARIANT]\n");
        return 2;
    }
    if (const auto done = run(argv[1], argc == 3 ? std::atoi(argv[2]) : 0); !done) {
        std::fprintf(stderr, "%s\n", done.error().message.c_str());
        return 2;
    }
    return 0;
}
