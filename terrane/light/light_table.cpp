#include "terrane/light/light_table.h"

#include <cassert>

namespace terrane::light {

LightTable::LightTable(const world::BlockRegistry& blocks) : missing_(blocks.missing()) {
    for (const world::BlockType& type : blocks.types()) {
        LightValue emission = kDark;
        for (int c = kRed; c <= kBlue; ++c) {
            const int level = type.emission[static_cast<std::size_t>(c)];
            assert(level <= kMaxLevel && "the registry checks levels");
            emission = withLevel(emission, c, level);
        }
        entries_.push_back({allComponents(type.opacity), emission});
    }
}

}  // namespace terrane::light
