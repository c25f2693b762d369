// Draws one of each kind of tree, bush and stone on flat ground into a PNG file: a complete path from a
// generator with stamps to an image. docs/worldgen.md shows the result.
//
//     arboretum IMAGE.png [VARIANT]
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
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
constexpr int kRadius = 4;   // chunks to draw
constexpr int kSide = 2 * kRadius + 3;

struct Place {
    Kind kind;
    int x, y;
};

// Three rows, the highest at the back.
constexpr Place kPlaces[] = {
    {Kind::Spruce, -54, 22}, {Kind::Larch, -37, 25}, {Kind::Pine, -25, 22},        {Kind::OldOak, 0, 26},
    {Kind::Cypress, 20, 22}, {Kind::Baobab, 35, 24}, {Kind::Palm, 54, 21},         {Kind::Birch, -44, 4},
    {Kind::Oak, -29, 4},     {Kind::Willow, -14, 4}, {Kind::GiantMushroom, 11, 4}, {Kind::DeadTree, 23, 2},
    {Kind::Acacia, 43, 2},   {Kind::Bush, -20, -9},  {Kind::Boulder, -3, -8},      {Kind::FallenLog, 18, -7},
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

// Lights all chunks and meshes those that have all neighbors.
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
    renderer->setViewDistance(3 * kRadius);
    show(gen::Generator(std::move(*graph), 1), *blocks, *renderer);
    render::RenderOptions options;
    options.msaaSamples = 4;
    options.depthOfField = options.godRays = false;
    if (auto done = renderer->configure({1080, 360}, options); !done) return done;
    render::FrameInput input{{{0.5, -90.0, 116.0}, 90, -14.5f, 20}, world::environmentAt(0.42f)};
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
