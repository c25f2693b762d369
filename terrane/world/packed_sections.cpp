#include "terrane/world/packed_sections.h"

namespace terrane::world {

void appendWords(PackedSections& packed, const Section& section) {
    for (const std::uint64_t word : section.words()) {
        packed.data.push_back(static_cast<shared::uint>(word));
        packed.data.push_back(static_cast<shared::uint>(word >> 32));
    }
}

}  // namespace terrane::world
