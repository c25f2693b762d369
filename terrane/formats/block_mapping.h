// Maps Minecraft's block names to blocks of Terrane and back: the built-in table
// assets/formats/minecraft.toml, and files of the user over it. Used by all readers and writers of files with
// block names. Immutable once created; any thread.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/legacy_ids.h"
#include "terrane/formats/named_state.h"
#include "terrane/world/block_registry.h"

namespace terrane::formats {

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

    // "terrane:NAME[state=N]" names the block itself. Unknown names become the registry's "missing";
    // isKnown() tells them apart.
    BlockAndState blockOf(const NamedState& state) const;
    bool isKnown(const NamedState& state) const;

    // A name that blockOf() maps back to this block and state: Minecraft's if there is one, else
    // "terrane:NAME", with the state if it is not 0.
    NamedState nameOf(BlockAndState block) const;

    // The doors of the registry: lower half and upper half.
    std::vector<std::pair<world::BlockId, world::BlockId>> doors() const;

    // Blocks by color, 0xRRGGBB.
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

// The built-in table, with a file of the user over it; `file` may be empty.
[[nodiscard]] base::Result<BlockMapping> loadMapping(const world::BlockRegistry& blocks,
                                                     const std::string& file);
[[nodiscard]] base::Result<LegacyIds> builtInLegacyIds();

}  // namespace terrane::formats
