// The worlds of the golden images.
#pragma once

#include <algorithm>
#include <map>
#include <string_view>

#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/world/block_model.h"
#include "terrane/world/world.h"
#include "tests/world/content_blocks.h"
#include "tests/world/put_block.h"

namespace terrane::golden {

using Meshes = std::map<world::ChunkPos, mesh::ChunkMesh>;

// Meshes of the chunks whose eight neighbors are in the world, as the stream makes them.
inline Meshes meshWorld(const world::World& world, const mesh::MeshOptions& options = {}) {
    Meshes meshes;
    mesh::MeshScratch scratch;
    world.forEachChunk([&](world::ChunkPos pos, const world::ChunkPtr& chunk) {
        const std::array<world::ChunkPtr, 4> beside = {
            world.maybeChunkAt({pos.x - 1, pos.y}), world.maybeChunkAt({pos.x + 1, pos.y}),
            world.maybeChunkAt({pos.x, pos.y - 1}), world.maybeChunkAt({pos.x, pos.y + 1})};
        if (std::ranges::any_of(beside, [](const world::ChunkPtr& c) { return !c; })) return;
        mesh::MeshInput input;
        input.center = chunk.get();
        for (std::size_t k = 0; k < beside.size(); ++k) input.neighbors[k] = beside[k].get();
        input.blocks = &contentBlocks();
        input.options = options;
        meshes[pos] = mesh::meshChunk(input, scratch);
    });
    return meshes;
}

inline world::World emptyWorld(int radius) {
    world::World world;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) world.insert({x, y}, std::make_shared<world::Chunk>());
    }
    return world;
}

inline world::World flatWorld(int radius) {
    auto graph = gen::makeGenerator("flat", contentBlocks());
    if (!graph) throw std::runtime_error(graph.error().message);
    const gen::Generator generator(*std::move(graph), 1);
    world::World world;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            world.insert({x, y}, std::make_shared<world::Chunk>(generator.generate({x, y})));
        }
    }
    return world;
}

constexpr int kGalleryZ = 81;  // on the flat world's grass

// By the place in the file of blocks: land is between water and chest; what people build with comes after it,
// first cubes, then shapes.
enum class GalleryPart : std::uint8_t { First, Land, Cubes, Shapes };

inline GalleryPart partOf(const world::BlockType& type) {
    if (type.id > contentBlock("chest")) return type.model ? GalleryPart::Shapes : GalleryPart::Cubes;
    return type.id > contentBlock("water") && type.name != "chest" ? GalleryPart::Land : GalleryPart::First;
}

// The block state at which a block stands in the gallery: shapes take turns at theirs.
inline std::uint16_t galleryState(const world::BlockType& type, int number, std::size_t stagesLeft) {
    return static_cast<std::uint16_t>(type.model ? 7 * number % 256 & type.model->stateMask : stagesLeft);
}

// Every block type of the part once, plants that grow at each stage, in rows of seven with gaps.
inline void placeGallery(world::World& world, GalleryPart part = GalleryPart::First) {
    constexpr int kRow = 7;
    int number = 0;
    for (const world::BlockType& type : contentBlocks().types()) {
        if (type.id == world::kAir || type.id == contentBlocks().missing()) continue;
        if (partOf(type) != part) continue;
        for (std::size_t left = 0; left <= type.growth.size(); ++left, ++number) {
            const world::BlockPos pos{2 * (number % kRow), 2 * (number / kRow), kGalleryZ};
            if (!world::putBlock(world, pos, type.id))
                throw std::runtime_error("the gallery is not in the world");
            world::putState(world, pos, galleryState(type, number, left));
        }
    }
}

// A pool three blocks deep in the flat world, with glass that stands in it and beyond it.
inline void placePool(world::World& world) {
    const world::BlockId water = contentBlock("water"), glass = contentBlock("cyan_glass");
    for (int y = 0; y < 14; ++y) {
        for (int x = 0; x < 14; ++x) {
            for (int z = kGalleryZ - 3; z < kGalleryZ; ++z) world::putBlock(world, {x, y, z}, water);
        }
    }
    for (const world::BlockPos pos :
         {world::BlockPos{5, 9, 80}, {5, 9, 81}, {10, 12, 81}, {11, 15, 81}, {3, 4, 79}}) {
        world::putBlock(world, pos, glass);
    }
}

}  // namespace terrane::golden
