// Which blocks of Terrane names of Minecraft stand for, and the other way round: the built-in table
// assets/formats/minecraft.toml, and files of the user over it. Called by all readers and writers of files
// with names. Immutable once made; any thread.
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
    // Later files come first where names have as many properties. Errors read "name:line: key: what is
    // wrong": a block that the registry lacks, a name that is none. The registry outlives the mapping.
    [[nodiscard]] static base::Result<BlockMapping> create(const world::BlockRegistry& blocks,
                                                           std::span<const MappingFile> files);

    // "terrane:NAME[state=N]" is the block itself. The registry's "missing" for unknown names: isKnown()
    // tells.
    BlockAndState blockOf(const NamedState& state) const;
    bool isKnown(const NamedState& state) const;

    // A name that blockOf() makes the same block and state of: Minecraft's where there is one, else
    // "terrane:NAME", with a state that is not 0.
    NamedState nameOf(BlockAndState block) const;

    // Doors of the registry: the lower half, the upper one.
    std::vector<std::pair<world::BlockId, world::BlockId>> doors() const;

    // By 0xRRGGBB.
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

// What is compiled in.
[[nodiscard]] base::Result<BlockMapping> builtInMapping(const world::BlockRegistry& blocks);
// The same with a file of the user over it; empty: none.
[[nodiscard]] base::Result<BlockMapping> loadMapping(const world::BlockRegistry& blocks,
                                                     const std::string& file);
[[nodiscard]] base::Result<LegacyIds> builtInLegacyIds();

}  // namespace terrane::formats
