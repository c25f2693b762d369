// Sections in the format of shaders (shared/packed_section.h): a list of heads, and their palettes and words
// one after the other. Light and meshing upload them to buffers of their own. No OpenGL; any thread.
#pragma once

#include <vector>

#include "terrane/shared/packed_section.h"
#include "terrane/world/section.h"

namespace terrane::world {

struct PackedSections {
    std::vector<shared::PackedSection> sections;
    std::vector<shared::uint> data;  // about 9 KB an overworld chunk

    void clear() {
        sections.clear();
        data.clear();
    }
};

// Appends the words of a section to the data, without a palette.
void appendWords(PackedSections& packed, const Section& section);

// Appends a section in its form. The palette, or the one value, becomes entryOf(value); values of dense
// sections stay. Returns its number.
template <typename EntryOf>
shared::uint appendSection(PackedSections& packed, const Section& section, EntryOf entryOf) {
    const auto place = [&] { return static_cast<shared::uint>(packed.data.size()); };
    shared::PackedSection head{static_cast<shared::uint>(section.bits()), place(), 0, 0};
    if (section.isUniform()) packed.data.push_back(entryOf(section.uniformValue()));
    for (const Section::Value value : section.palette()) packed.data.push_back(entryOf(value));
    head.words = place();
    appendWords(packed, section);
    packed.sections.push_back(head);
    return static_cast<shared::uint>(packed.sections.size() - 1);
}

}  // namespace terrane::world
