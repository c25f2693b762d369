// Block types: appearance, light, collision. Types are content (assets/blocks.toml), read by
// block_registry.h.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/shared/material.h"
#include "terrane/shared/shape_face.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/chunk.h"

namespace terrane::world {

// Materials of blocks for the sounds of steps, placing and breaking.
enum class SoundMaterial : std::uint8_t {
    None,
    Stone,
    Wood,
    Earth,
    Sand,
    Grass,
    Glass,
    Wool,
    Metal,
    Snow,
    Water
};

// Names in content files and in names of sounds, by SoundMaterial.
constexpr std::array<std::string_view, 11> kSoundMaterialNames{
    "none", "stone", "wood", "earth", "sand", "grass", "glass", "wool", "metal", "snow", "water"};

enum class Shape : std::uint8_t {
    None,    // nothing to draw (air)
    Cube,    // six faces; merges with its neighbors
    Liquid,  // like a cube; the surface under anything but the same liquid lies lower (LiquidSurface)
    Cross,   // X: two upright planes through the middle
    Hash,    // #: four upright planes, a quarter inside the cell
    Inset,   // #: four upright planes 1/16 inside the cell, and full top and bottom (cactus)
    Model,   // boxes in the cell, as its block state says (block_model.h)
};

// The meaning of the alpha channel of a face's texture.
enum class AlphaMode : std::uint8_t {
    Unused,    // opaque
    Test,      // below one half: a hole
    Blend,     // coverage
    Glow,      // opaque; alpha is the share of light the texel gives by itself
    TestGlow,  // below one quarter: a hole; above, (alpha − 0.5)·2 clamped is the glow
    Tint,      // opaque; alpha is the share of the tint that the texel takes, of a tinted face
};

enum class Animation : std::uint8_t { None, TopWaves, WholeWaves, LiquidSurface };

// The texels that filters of a face's texture may read.
enum class Wrap : std::uint8_t {
    Quad,    // the texture repeats over a merged quad; filters stop at the quad's edge
    Repeat,  // filters reach over every edge to the opposite side of the texture: it tiles without seams
    Clamp,   // filters stop at the edge of each block's texture, inside a merged quad too
};

// The filter of a face's texture.
enum class Filtering : std::uint8_t {
    Option,   // as the graphics option says (--sharp-filtering)
    Sharp,    // as with the option on
    Nearest,  // as with the option off
};

// Kinds of tools that break blocks faster.
enum class ToolKind : std::uint8_t { None, Pick, Axe, Shovel, Sword };

// What a block gives in survival when it is broken.
struct Drop {
    std::string item;  // empty: the block itself
    int count = 1;     // 0: nothing
};

// The top of a liquid under anything but the same liquid. Integers, so that equal ones compare equal.
struct LiquidSurface {
    // In the cell; shared::kSurfaceUnits a block.
    std::uint16_t heightUnits = shared::kLiquidSurfaceSixteenths * shared::kSurfaceUnits / 16;
    // Amplitude of Animation::LiquidSurface; shared::kWaveUnits a block.
    std::uint16_t waveUnits = 60;

    auto operator<=>(const LiquidSurface&) const = default;
};

// A texture, and how faces with it are drawn.
struct Material {
    std::uint16_t texture = 0;  // index into BlockRegistry::textures()
    AlphaMode alpha = AlphaMode::Unused;
    Animation animation = Animation::None;
    bool twoSided = false;
    Wrap wrap = Wrap::Quad;
    Filtering filtering = Filtering::Option;
    LiquidSurface surface = {};
    bool tinted = false;  // takes the column's tint (tint.h)

    auto operator<=>(const Material&) const = default;
};

struct BlockBehavior;
struct BlockModel;

struct BlockType {
    std::string name;
    BlockId id = 0;
    Shape shape = Shape::Cube;
    std::shared_ptr<const BlockModel> model;           // of Shape::Model
    std::array<std::uint16_t, kFaceCount> material{};  // index into BlockRegistry::materials()
    bool opaqueCube = false;                           // hides every face that touches it
    // Materials of a growing plant by block state, which counts the stages left; growth[0] for 1.
    std::vector<std::uint16_t> growth;
    LiquidSurface surface;                   // of a liquid
    bool innerFaces = false;                 // faces between two blocks of this type are drawn (leaves)
    std::uint8_t opacity = 15;               // to light, 0…15
    std::array<std::uint8_t, 3> emission{};  // red, green, blue, 0…15
    std::vector<Box> collision;              // empty: nothing collides
    Box selection;                           // what a ray from the camera hits
    bool selectable = true;                  // false: rays pass (air, water)
    bool generated = true;                   // appears in generated terrain (else placed only)
    bool climbable = false;                  // characters in it climb
    bool replaceable = false;                // a player's new block takes its place (grass)
    std::string group;                       // of the palette of blocks
    // Behaviors (block_behavior.h) in the order in which they are called.
    std::vector<std::shared_ptr<const BlockBehavior>> behaviors;
    SoundMaterial sound = SoundMaterial::None;
    int slots = 0;  // of the behavior container: stacks of items it holds
    // Of survival (terrane/world/items). The seconds that it takes to break the block by hand, the tool that
    // is faster, and the least level of this tool that makes the block drop something.
    double hardness = 0;
    ToolKind tool = ToolKind::None;
    int toolLevel = 0;
    Drop drop = {};
};

}  // namespace terrane::world
