// Maps Minecraft's block names to blocks of Terrane and back: the built-in table
// assets/formats/minecraft.toml, and files of the user over it. It is used by all readers and writers of
// files with block names. It is immutable; any thread may use it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/blocks/block_type.h"

namespace terrane::formats {

// The name of a block in other programs: "minecraft:oak_stairs[facing=east,half=bottom]". All are plain
// values; any thread may use them.
struct NamedState {
    std::string name;                                             // with its namespace
    std::vector<std::pair<std::string, std::string>> properties;  // by name, each once

    // Returns the value of the property; null if there is none.
    const std::string* property(std::string_view property) const;
    // Sets the property; the properties stay sorted by name.
    void set(std::string_view property, std::string value);
    bool operator==(const NamedState&) const = default;
};

// Returns the text form of schematics. It is the inverse of namedState() if no name contains any of "[]=,".
std::string textOf(const NamedState& state);
// Parses the text form. A name without namespace gets "minecraft:". Returns nothing if the text is invalid:
// an empty name, a bracket that does not close, a property without value.
std::optional<NamedState> namedState(std::string_view text);

// Block numbers of Minecraft 1.12 and older: an id (0…4095) and four bits of data for each block. A table
// (assets/formats/minecraft_ids.toml) gives the names that replace them since 1.13. Any thread may use it.
class LegacyIds {
  public:
    // Reads the text of the table. Errors read "name:line: key: what is wrong". One table [ids]:
    //   53 = "oak_stairs[half=bottom]"          for all data
    //   5 = ["oak_planks", "spruce_planks", …]  by data; beyond the last: entry data - 8, else the first
    [[nodiscard]] static base::Result<LegacyIds> parse(std::string_view toml, std::string_view name);

    // Returns the name of a number and its data, or "minecraft:id_7_1" for numbers that the table lacks.
    NamedState stateOf(int id, int data) const;

  private:
    std::vector<std::vector<NamedState>> byId_;
};

// The next two functions convert properties of Minecraft's blocks to block states and back: facing, halves,
// open doors, arms of fences, levels of water, growth. Any thread may call them.
//
// Minecraft's x, y, z (east, up, south) are our -x, z, y, so that the sun rises in the same east and maps
// have the same north, -y (game/places.h). Nothing is mirrored. Returns the bits of the block state that the
// properties of `state` set for a block of `type`; 0 if they set none. `isOpposite`: the block faces against
// its property.
std::uint16_t stateOfProperties(const world::BlockType& type, const NamedState& state, bool isOpposite);

// Adds the properties that correspond to the block state. Properties that `named` already has stay.
void addProperties(const world::BlockType& type, std::uint16_t state, bool isOpposite, NamedState& named);

struct BlockAndState {
    world::BlockId id = world::kAir;
    std::uint16_t state = 0;
    bool operator==(const BlockAndState&) const = default;
};

struct MappingFile {
    std::string_view toml;
    std::string name;  // in errors
};

class BlockMapping {
  public:
    // Names in later files have priority over those with as many properties in earlier ones. Errors read
    // "name:line: key: what is wrong": a block that the registry lacks, an invalid name. The registry
    // outlives the mapping.
    [[nodiscard]] static base::Result<BlockMapping> create(const world::BlockRegistry& blocks,
                                                           std::span<const MappingFile> files);

    // Returns the block of a name. "terrane:NAME[state=N]" names a block of the registry. Unknown names
    // become the registry's "missing"; isKnown() tells them apart.
    BlockAndState blockOf(const NamedState& state) const;
    bool isKnown(const NamedState& state) const;

    // Returns a name that blockOf() maps back to this block and state: Minecraft's if there is one, else
    // "terrane:NAME", with the state if it is not 0.
    NamedState nameOf(BlockAndState block) const;

    // Returns the doors of the registry: lower half and upper half.
    std::vector<std::pair<world::BlockId, world::BlockId>> doors() const;

    // Returns the blocks by color, 0xRRGGBB.
    const std::map<std::uint32_t, world::BlockId>& colors() const { return colors_; }

  private:
    struct Entry {
        NamedState name;
        BlockAndState block;
    };
    class Reader;

    explicit BlockMapping(const world::BlockRegistry& blocks) : blocks_(&blocks) {}
    const Entry* entryOf(const NamedState& state) const;
    BlockAndState applied(const Entry& entry, const NamedState& state) const;
    bool isOpposite(world::BlockId id) const;

    const world::BlockRegistry* blocks_;
    std::vector<Entry> entries_;  // in the order of the files
    std::unordered_map<std::string, std::vector<std::size_t>> byName_;
    std::unordered_map<world::BlockId, std::vector<std::size_t>> byBlock_;
    std::vector<world::BlockId> opposite_;
    std::map<std::uint32_t, world::BlockId> colors_;
};

// Loads the built-in table, with a file of the user over it; `file` may be empty.
[[nodiscard]] base::Result<BlockMapping> loadMapping(const world::BlockRegistry& blocks,
                                                     const std::string& file);
[[nodiscard]] base::Result<LegacyIds> builtInLegacyIds();

}  // namespace terrane::formats
