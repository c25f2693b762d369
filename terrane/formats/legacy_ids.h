// Block numbers of Minecraft 1.12 and older: an id (0…4095) and four bits of data for each block. A table
// (assets/formats/minecraft_ids.toml) gives the names that replace them since 1.13. Any thread.
#pragma once

#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/named_state.h"

namespace terrane::formats {

class LegacyIds {
  public:
    // Reads the text of the table. Errors read "name:line: key: what is wrong". One table [ids]:
    //   53 = "oak_stairs[half=bottom]"          for all data
    //   5 = ["oak_planks", "spruce_planks", …]  by data; beyond the last: entry data - 8, else the first
    [[nodiscard]] static base::Result<LegacyIds> parse(std::string_view toml, std::string_view name);

    // "minecraft:id_7_1" for numbers that the table lacks.
    NamedState stateOf(int id, int data) const;

  private:
    std::vector<std::vector<NamedState>> byId_;
};

}  // namespace terrane::formats
