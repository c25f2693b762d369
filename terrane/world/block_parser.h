// Reads a content file of block types (TOML, see assets/blocks.toml) into descriptions that name textures and
// carry no ids yet. Called by block_registry.cpp on the thread that starts a session.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/block_behavior.h"
#include "terrane/world/shape_parser.h"

namespace terrane::world {

// Ids are 16 bits; air takes the first and "missing" the one after the file's.
constexpr std::size_t kMaxDescribedBlocks = 65536 - 2;
constexpr std::size_t kMaxGrowthStages = 15;
constexpr int kMaxSlots = 256;

// What one face looks like.
struct FaceLook {
    std::string texture;
    AlphaMode alpha = AlphaMode::Unused;
    bool twoSided = false;
    Wrap wrap = Wrap::Quad;
    Filtering filtering = Filtering::Option;
    bool tinted = false;
};

struct BlockDescription {
    BlockType type;  // all but id and materials
    std::array<FaceLook, kFaceCount> faces;
    std::vector<FaceLook> growth;  // of all faces, youngest stage first
    Animation animation = Animation::None;
    ShapePtr shape;  // of Shape::Model
    int line = 0;    // of its table in the file
};

// The file's blocks in its order, names unique. Errors read "file:line: key: what is wrong", always one line.
// `behaviors`: those that blocks may name.
[[nodiscard]] base::Result<std::vector<BlockDescription>> parseBlocks(
    std::string_view toml, std::string_view file, const BehaviorTable& behaviors = builtInBehaviors());

// A cube that hides what touches it: no face lets the eye through.
bool isOpaqueCube(const BlockDescription& block);

// The boxes a shape fills where the file names none.
Box shapeBox(Shape shape);

}  // namespace terrane::world
