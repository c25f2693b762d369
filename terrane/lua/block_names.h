// Blocks by the names that scripts of a pack use: "x" is "PACK:x" if the registry has it, else "x".
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrane/world/blocks/block_registry.h"

namespace terrane::lua {

// Finds the blocks of a registry by the names that scripts use, and records the names that it found.
class BlockNames {
  public:
    using Aliases = std::map<std::string, std::string, std::less<>>;

    // `aliases` has names in the registry by the names in the script.
    BlockNames(const world::BlockRegistry& blocks, std::string_view pack, Aliases aliases = {})
        : blocks_(blocks), pack_(pack), aliases_(std::move(aliases)) {}

    // Returns the registry's name of a block. A block of the pack comes first. Throws ScriptError if there is
    // none.
    std::string find(std::string_view name);
    // Returns the registry's names from find() and addUsed() in the order of first use, without air.
    const std::vector<std::string>& used() const { return used_; }
    void addUsed(std::string_view name);

  private:
    const world::BlockRegistry& blocks_;
    std::string pack_;
    Aliases aliases_;
    std::vector<std::string> used_;
};

}  // namespace terrane::lua
