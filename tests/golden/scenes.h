// The worlds of the golden images.
#pragma once

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/world/blocks/block_model.h"
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

// The blocks that the galleries show, a fixed sample with each shape, alpha and animation: a new block that
// has no other is not added. First the basic blocks, then those of the land of `continents`, then the cubes
// and the shapes that people build with.
constexpr std::string_view kFirstGallery =
    "stone dirt grass sand snow glowing_ore oak_log oak_leaves grass_tuft blue_orchid poppy "
    "oxeye_daisy wheat red_mushroom brown_mushroom glowing_mushroom cactus lamp_white "
    "lamp_red lamp_green lamp_blue cyan_glass water chest";

constexpr std::string_view kLandGallery =
    "birch_log birch_leaves spruce_log spruce_leaves pine_log pine_leaves acacia_log "
    "acacia_leaves willow_log willow_leaves palm_log palm_leaves dead_log moss mossy_stone "
    "gravel clay mud ice red_sand sandstone red_sandstone terracotta basalt limestone "
    "tall_grass savanna_grass fern reeds heather bluebell dead_bush crystal coral_red "
    "coral_yellow seagrass mushroom_stem mushroom_cap";

constexpr std::string_view kCubesGallery =
    "oak_planks birch_planks spruce_planks pine_planks acacia_planks willow_planks "
    "palm_planks cobble stone_bricks bricks smooth_stone roof_tiles thatch plaster bookshelf "
    "hay iron glass white_glass red_glass orange_glass yellow_glass green_glass blue_glass "
    "purple_glass white_wool red_wool orange_wool yellow_wool green_wool cyan_wool blue_wool "
    "purple_wool brown_wool black_wool";

constexpr std::string_view kShapesGallery =
    "oak_stairs birch_stairs spruce_stairs pine_stairs acacia_stairs willow_stairs "
    "palm_stairs stone_stairs cobble_stairs stone_bricks_stairs bricks_stairs "
    "sandstone_stairs roof_tiles_stairs thatch_stairs oak_slab birch_slab spruce_slab "
    "pine_slab acacia_slab willow_slab palm_slab stone_slab cobble_slab stone_bricks_slab "
    "bricks_slab sandstone_slab roof_tiles_slab thatch_slab glass_pane white_carpet "
    "red_carpet orange_carpet yellow_carpet green_carpet cyan_carpet blue_carpet "
    "purple_carpet brown_carpet black_carpet oak_fence birch_fence spruce_fence pine_fence "
    "acacia_fence willow_fence palm_fence oak_gate birch_gate spruce_gate pine_gate "
    "acacia_gate willow_gate palm_gate oak_door oak_door_top oak_trapdoor ladder torch sign "
    "lantern";

// The block types of a gallery.
inline std::vector<const world::BlockType*> galleryTypes(std::string_view gallery) {
    std::vector<const world::BlockType*> types;
    std::istringstream names{std::string(gallery)};
    for (std::string name; names >> name;) types.push_back(&contentBlocks().type(contentBlock(name)));
    return types;
}

// The block state at which a block stands in the gallery: shapes take turns at theirs.
inline std::uint16_t galleryState(const world::BlockType& type, int number, std::size_t stagesLeft) {
    return static_cast<std::uint16_t>(type.model ? 7 * number % 256 & type.model->stateMask : stagesLeft);
}

// The blocks of a gallery, plants that grow at each stage, in rows of seven with gaps.
inline void placeGallery(world::World& world, std::string_view gallery = kFirstGallery) {
    constexpr int kRow = 7;
    int number = 0;
    for (const world::BlockType* type : galleryTypes(gallery)) {
        for (std::size_t left = 0; left <= type->growth.size(); ++left, ++number) {
            const world::BlockPos pos{2 * (number % kRow), 2 * (number / kRow), kGalleryZ};
            if (!world::putBlock(world, pos, type->id))
                throw std::runtime_error("the gallery is not in the world");
            world::putState(world, pos, galleryState(*type, number, left));
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
