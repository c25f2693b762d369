// Maps block ids of a save to ids of the session and back. A save names its block types, so a build with
// other blocks, or another order of blocks, reads it correctly.
//
// Immutable once made; shared by all threads.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::store {

struct SavedName {
    world::BlockId id = 0;  // in the save
    std::string name;
};

class BlockIdMap {
  public:
    static constexpr std::uint32_t kNone = 0xFFFF'FFFF;

    // Creates the map. `saved` has the names of the save, without duplicate ids or names. Types of the
    // registry that the save lacks get unused ids. Names that the registry lacks get session ids after the
    // registry's last one, for which BlockRegistry::type returns "missing": they are drawn, and saved with
    // their own id. Fails if more than 65,536 types are needed.
    [[nodiscard]] static base::Result<BlockIdMap> make(const world::BlockRegistry& registry,
                                                       const std::vector<SavedName>& saved);

    std::uint32_t toSession(world::BlockId saved) const { return at(toSession_, saved); }  // kNone: no name
    std::uint32_t toSaved(world::BlockId session) const {
        return at(toSaved_, session);
    }  // kNone: no such type

    const std::vector<SavedName>& names() const { return names_; }        // all names, the added ones last
    const std::vector<SavedName>& added() const { return added_; }        // to be written into the save
    const std::vector<std::string>& unknown() const { return unknown_; }  // names the registry lacks

  private:
    static std::uint32_t at(const std::vector<std::uint32_t>& table, world::BlockId id) {
        return id < table.size() ? table[id] : kNone;
    }

    std::vector<std::uint32_t> toSession_, toSaved_;
    std::vector<SavedName> names_, added_;
    std::vector<std::string> unknown_;
};

}  // namespace terrane::store
