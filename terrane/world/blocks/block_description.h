// Descriptions of block types, which refer to textures and blocks by name. They are read from a file
// (block_parser.h) or made by a program; BlockRegistry::fromDescriptions() makes types of them. All are plain
// values.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "terrane/world/blocks/behavior_template.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_type.h"

namespace terrane::world {

// The appearance of one face.
struct FaceDescription {
    std::string texture;
    AlphaMode alpha = AlphaMode::Unused;
    bool twoSided = false;
    Wrap wrap = Wrap::Quad;
    Filtering filtering = Filtering::Option;
    bool tinted = false;
};

struct BlockDescription {
    BlockType type;  // all but id and materials
    std::array<FaceDescription, kFaceCount> faces;
    std::vector<FaceDescription> growth;  // of all faces, youngest stage first
    Animation animation = Animation::None;
    ShapePtr shape;                   // of Shape::Model
    std::vector<BehaviorCall> calls;  // behaviors with arguments; block names as the file has them
    std::string file;                 // for messages; of a program: its name
    int line = 0;                     // of its table in the file
};

// Returns whether the block is a cube without transparent faces, which hides adjacent faces.
bool isOpaqueCube(const BlockDescription& block);

// Returns the default box of a shape.
Box shapeBox(Shape shape);

}  // namespace terrane::world
