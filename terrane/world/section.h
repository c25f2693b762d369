// A section: 16³ values of 16 bits (block ids or block state), stored as small as they allow.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "terrane/shared/packed_section.h"
#include "terrane/world/coords.h"

namespace terrane::world {

// Index in a section: x + 16 y + 256 z, 0…4095.
//
// Three forms, chosen by the content:
//   uniform  one value                                    0 bytes beside the object
//   palette  distinct values + 1, 2, 4 or 8 bits a block  512, 1,024, 2,048 or 4,096 bytes + palette
//   dense    16 bits a block                              8,192 bytes
// A set() that brings a new value widens the form; compact() finds the smallest again. It is not
// synchronised: one writer or many readers may use it.
class Section {
  public:
    using Value = std::uint16_t;

    explicit Section(Value value = 0) : uniform_(value) {}

    // Returns the smallest form of 4,096 values.
    static Section fromValues(std::span<const Value, kBlocksPerSection> values);

    // Returns a section that is not uniform from its bits(), palette() and words(), in the same form. Returns
    // nothing unless `bits` is 1, 2, 4, 8 or 16 and `words` holds 64 · bits of them, or if the index of a
    // block has no value in the palette, or if the palette is longer than `bits` can tell apart.
    static std::optional<Section> fromPacked(int bits, std::vector<Value> palette,
                                             std::vector<std::uint64_t> words);

    Value get(int index) const {
        assert(index >= 0 && index < kBlocksPerSection && "index of a block in a section");
        if (isUniform()) return uniform_;
        const std::uint32_t at = packed(index);
        return isDense() ? static_cast<Value>(at) : palette_[at];
    }
    void set(int index, Value value);
    void unpack(std::span<Value, kBlocksPerSection> values) const;
    // Unpacks the section with mapped[k] in place of palette()[k]: one lookup for each palette entry instead
    // of each block. Palette form only; mapped has the size of palette().
    void unpackMapped(std::span<const Value> mapped, std::span<Value, kBlocksPerSection> values) const;
    void compact();

    bool isUniform() const { return bits_ == 0; }
    Value uniformValue() const { return uniform_; }  // only where isUniform()
    bool isDense() const { return bits_ == 16; }

    // Returns the bits of a block: 0 (uniform), 1, 2, 4, 8 (palette) or 16 (dense).
    int bits() const { return bits_; }
    // Returns the distinct values in order of index; may have values that no block has any more. The result
    // is empty unless palette form.
    std::span<const Value> palette() const { return palette_; }
    // Returns the packed data. Palette form: indices, bits() each, lowest index in the lowest bits. Dense
    // form: values, 16 bits each.
    std::span<const std::uint64_t> words() const { return words_; }

    // Returns true if all values surely meet the condition. Returns false for dense sections, which are not
    // searched, and if a value of the palette does not meet it, even if no block has that value any more.
    template <class Condition>
    bool surelyAll(const Condition& condition) const {
        if (isUniform()) return condition(uniform_);
        return !isDense() && std::all_of(palette_.begin(), palette_.end(), condition);
    }

    std::size_t memoryBytes() const;  // heap and object

    friend bool operator==(const Section& a, const Section& b);  // equal values, whatever the forms

  private:
    std::uint32_t packed(int index) const {
        const auto bit =
            static_cast<std::size_t>(index) * bits_;  // widths are powers of two: none crosses a word
        return static_cast<std::uint32_t>(words_[bit / 64] >> bit % 64) & ((1u << bits_) - 1);
    }
    void setPacked(int index, std::uint32_t packed);
    void repack(int bits);

    std::vector<std::uint64_t> words_;
    std::vector<Value> palette_;
    Value uniform_ = 0;
    std::uint8_t bits_ = 0;
};

// Sections in the format of shaders (shared/packed_section.h): a list of headers, and their palettes and
// words one after the other. Light and meshing upload them to buffers of their own. They need no OpenGL; any
// thread may use them.
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
