// A section: 16³ values of 16 bits (block ids or block state), stored as small as they allow.
#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "terrane/shared/packed_section.h"
#include "terrane/world/coords.h"

namespace terrane::world {

// Index in a section: x + 16 y + 256 z, 0…4095.
//
// Three forms, chosen by the content:
//   uniform  one value                                    0 bytes beside the object, which has 8
//   palette  distinct values + 1, 2, 4 or 8 bits a block  512, 1,024, 2,048 or 4,096 bytes + palette
//   dense    16 bits a block                              8,192 bytes
// A set() that brings a new value widens the form; compact() finds the smallest again.
//
// Copies share their memory until one of them is written, so that a copy costs next to nothing. One writer or
// many readers may use a section; its copies may be used on other threads at the same time.
class Section {
  public:
    using Value = std::uint16_t;

    explicit Section(Value value = 0) : content_(uniformContent(value)) {}
    Section(const Section& other) : content_(other.content_) { share(); }
    Section(Section&& other) noexcept : content_(std::exchange(other.content_, uniformContent(0))) {}
    Section& operator=(Section other) noexcept {
        std::swap(content_, other.content_);
        return *this;
    }
    ~Section() { release(); }

    // Returns the smallest form of 4,096 values.
    static Section fromValues(std::span<const Value, kBlocksPerSection> values);

    // Returns a section that is not uniform from its bits(), palette() and words(), in the same form. Returns
    // nothing unless `bits` is 1, 2, 4, 8 or 16 and `words` holds 64 · bits of them, or if the index of a
    // block has no value in the palette, or if the palette is longer than `bits` can tell apart.
    static std::optional<Section> fromPacked(int bits, std::span<const Value> palette,
                                             std::span<const std::uint64_t> words);

    Value get(int index) const {
        assert(index >= 0 && index < kBlocksPerSection && "index of a block in a section");
        if (isUniform()) return uniformValue();
        const Packed& p = packed();
        // Widths are powers of two: no index crosses a word.
        const auto bit = static_cast<std::size_t>(index) * p.bits;
        const auto at = static_cast<std::uint32_t>(p.words()[bit / 64] >> bit % 64) & ((1u << p.bits) - 1);
        return p.bits == kDenseBits ? static_cast<Value>(at) : p.palette()[at];
    }
    void set(int index, Value value);
    void unpack(std::span<Value, kBlocksPerSection> values) const;
    // Unpacks the section with mapped[k] in place of palette()[k]: one lookup for each palette entry instead
    // of each block. Palette form only; mapped has the size of palette().
    void unpackMapped(std::span<const Value> mapped, std::span<Value, kBlocksPerSection> values) const;
    void compact();

    bool isUniform() const { return (content_ & kUniformMark) != 0; }
    Value uniformValue() const { return static_cast<Value>(content_ >> 1); }  // only where isUniform()
    bool isDense() const { return bits() == kDenseBits; }

    // Returns the bits of a block: 0 (uniform), 1, 2, 4, 8 (palette) or 16 (dense).
    int bits() const { return isUniform() ? 0 : packed().bits; }
    // Returns the distinct values in order of index; may have values that no block has any more. The result
    // is empty unless palette form.
    std::span<const Value> palette() const {
        if (isUniform()) return {};
        return {packed().palette(), packed().paletteSize};
    }
    // Returns the packed data. Palette form: indices, bits() each, lowest index in the lowest bits. Dense
    // form: values, 16 bits each.
    std::span<const std::uint64_t> words() const {
        if (isUniform()) return {};
        return {packed().words(), packed().wordCount()};
    }

    // Returns true if all values surely meet the condition. Returns false for dense sections, which are not
    // searched, and if a value of the palette does not meet it, even if no block has that value any more.
    template <class Condition>
    bool surelyAll(const Condition& condition) const {
        if (isUniform()) return condition(uniformValue());
        const std::span<const Value> values = palette();
        return !isDense() && std::all_of(values.begin(), values.end(), condition);
    }

    // Returns whether the two are copies that share their memory, or uniform with the same value: then they
    // are equal, without a look at their blocks.
    bool isSame(const Section& other) const { return content_ == other.content_; }

    std::size_t memoryBytes() const;  // heap, also where it is shared, and object

    friend bool operator==(const Section& a, const Section& b);  // equal values, whatever the forms

  private:
    static constexpr int kDenseBits = 16;
    static constexpr std::uintptr_t kUniformMark = 1;

    // The header of a block of memory with the words and then the palette.
    struct alignas(std::uint64_t) Packed {
        std::atomic<std::uint32_t> owners{1};
        std::uint16_t paletteSize = 0, paletteRoom = 0;  // values
        std::uint8_t bits = 0;

        static Packed* make(int bits, std::size_t paletteRoom);
        static std::size_t bytesOf(int bits, std::size_t paletteRoom);
        std::size_t wordCount() const { return std::size_t{kBlocksPerSection / 64} * bits; }
        std::uint64_t* words() { return reinterpret_cast<std::uint64_t*>(this + 1); }
        const std::uint64_t* words() const { return reinterpret_cast<const std::uint64_t*>(this + 1); }
        Value* palette() { return reinterpret_cast<Value*>(words() + wordCount()); }
        const Value* palette() const { return reinterpret_cast<const Value*>(words() + wordCount()); }
    };

    static constexpr std::uintptr_t uniformContent(Value value) {
        return std::uintptr_t{value} << 1 | kUniformMark;
    }
    explicit Section(Packed* packed) : content_(reinterpret_cast<std::uintptr_t>(packed)) {}
    Packed& packed() { return *reinterpret_cast<Packed*>(content_); }
    const Packed& packed() const { return *reinterpret_cast<const Packed*>(content_); }
    void share() const {
        if (!isUniform()) reinterpret_cast<Packed*>(content_)->owners.fetch_add(1, std::memory_order_relaxed);
    }
    void release();
    // Makes the memory this section's alone, with room for one more value in the palette.
    void own(bool growsPalette);
    void setPacked(int index, std::uint32_t packed);
    void repack(int bits);

    // The one value and kUniformMark, or the address of a Packed.
    std::uintptr_t content_;
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
