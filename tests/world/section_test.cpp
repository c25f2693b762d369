#include "terrane/world/section.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

namespace terrane::world {
namespace {

using Values = std::array<Section::Value, kBlocksPerSection>;

Values unpacked(const Section& section) {
    Values values;
    section.unpack(values);
    return values;
}

std::vector<Section::Value> inOrderOfFirst(const Values& values) {
    std::vector<Section::Value> result;
    std::set<Section::Value> seen;
    for (const Section::Value value : values)
        if (seen.insert(value).second) result.push_back(value);
    return result;
}

int smallestBits(std::size_t distinct) {
    if (distinct == 1) return 0;
    for (int bits = 1; bits <= 8; bits *= 2)
        if (distinct <= std::size_t{1} << bits) return bits;
    return 16;
}

void expectSmallest(const Section& section, const Values& values) {
    const auto distinct = inOrderOfFirst(values);
    ASSERT_EQ(section.bits(), smallestBits(distinct.size()));
    ASSERT_EQ(unpacked(section), values);
    if (section.isUniform()) {
        ASSERT_EQ(section.uniformValue(), values[0]);
    }
    if (section.isUniform() || section.isDense()) {
        ASSERT_TRUE(section.palette().empty());
    } else {
        ASSERT_TRUE(
            std::equal(distinct.begin(), distinct.end(), section.palette().begin(), section.palette().end()));
    }
}

// Values with exactly `distinct` different ones, up to 4,096, spread over 16 bits and in random order.
Values valuesWith(int distinct, std::mt19937& random) {
    Values values;
    for (int i = 0; i < kBlocksPerSection; ++i) {
        const int which = i < distinct ? i : static_cast<int>(random()) & 0xFFFF;
        values[static_cast<std::size_t>(i)] = static_cast<Section::Value>(65535 - 13 * (which % distinct));
    }
    std::shuffle(values.begin(), values.end(), random);
    return values;
}

// A section and the plain array that it must equal.
struct Pair {
    Section section;
    Values plain{};

    void set(int index, Section::Value value) {
        section.set(index, value);
        plain[static_cast<std::size_t>(index)] = value;
    }

    // Random writes of `distinct` values from `base` on, each read back; every form is left by more values.
    void writeRandomly(int writes, int distinct, Section::Value base, std::mt19937& random) {
        for (int i = 0; i < writes; ++i) {
            const int index = static_cast<int>(random() % kBlocksPerSection);
            set(index, static_cast<Section::Value>(base + random() % static_cast<unsigned>(distinct)));
            ASSERT_EQ(section.get(index), plain[static_cast<std::size_t>(index)]);
            const int other = static_cast<int>(random() % kBlocksPerSection);
            ASSERT_EQ(section.get(other), plain[static_cast<std::size_t>(other)]);
        }
    }
};

// 1.6 million writes that walk up and down through all forms.
TEST(Section, EqualsPlainArray) {
    std::mt19937 random(1);
    Pair pair;
    std::set<int> forms;
    for (int round = 0; round < 10; ++round)
        for (const int distinct : {1, 2, 3, 4, 7, 16, 60, 256, 4000, 300, 16, 5, 4, 2, 2, 1}) {
            pair.writeRandomly(10000, distinct, static_cast<Section::Value>(random()), random);
            ASSERT_EQ(unpacked(pair.section), pair.plain);
            if (distinct <= 256) {
                // Overwrites earlier values, so that compact() can find a smaller form.
                const auto base = static_cast<Section::Value>(random());
                for (int i = 0; i < kBlocksPerSection; ++i)
                    pair.set(i, static_cast<Section::Value>(base + i % distinct));
            }
            pair.section.compact();
            expectSmallest(pair.section, pair.plain);
            forms.insert(pair.section.bits());
        }
    EXPECT_EQ(forms, (std::set<int>{0, 1, 2, 4, 8, 16}));
}

TEST(Section, FromValuesFindsTheSmallestForm) {
    std::mt19937 random(2);
    for (const int distinct : {1, 2, 3, 4, 5, 15, 16, 17, 100, 255, 256, 257, 1000, 4096})
        for (int repeat = 0; repeat < 4; ++repeat) {
            const Values values = valuesWith(distinct, random);
            expectSmallest(Section::fromValues(values), values);
        }
}

TEST(Section, FromValuesSeesASingleOddValueAnywhere) {
    for (const std::size_t at : {0, 1, 63, 64, 2048, 4094, 4095}) {
        Values values;
        values.fill(65535);
        values[at] = 0;
        expectSmallest(Section::fromValues(values), values);
    }
}

// A value's new form must keep what the old one held, at every step.
TEST(Section, SetWidensStepByStep) {
    Pair pair{.section = Section(7), .plain = {}};
    pair.plain.fill(7);
    EXPECT_TRUE(pair.section.isUniform());
    pair.set(100, 7);
    EXPECT_TRUE(pair.section.isUniform()) << "writing the value it has changes nothing";
    for (int i = 1; i <= 300; ++i) {
        pair.set(i * 13, static_cast<Section::Value>(1000 + i));
        EXPECT_EQ(pair.section.bits(), smallestBits(static_cast<std::size_t>(i) + 1));
        ASSERT_EQ(unpacked(pair.section), pair.plain);
    }
}

TEST(Section, WordsHoldLowestIndexLowest) {
    Section section(5);
    section.set(0, 6);
    section.set(65, 6);
    ASSERT_EQ(section.bits(), 1);
    EXPECT_EQ(section.words()[0], 1u);
    EXPECT_EQ(section.words()[1], 2u);
    EXPECT_EQ(section.palette()[0], 5);
    EXPECT_EQ(section.palette()[1], 6);
}

// Bytes beside the object as the header states them; a palette may have room to grow to twice its size.
TEST(Section, MemoryBytesOfEachForm) {
    std::mt19937 random(3);
    struct Case {
        int distinct;
        std::size_t words, palette;
    };
    for (const Case& c : {Case{1, 0, 0}, Case{2, 512, 2}, Case{4, 1024, 4}, Case{16, 2048, 16},
                          Case{256, 4096, 256}, Case{257, 8192, 0}}) {
        const Values values = valuesWith(c.distinct, random);
        constexpr std::size_t kHeader = 16;
        const std::size_t own = sizeof(Section) + (c.words > 0 ? kHeader : 0);
        EXPECT_EQ(Section::fromValues(values).memoryBytes(), own + c.words + 2 * c.palette);

        Section grown(values[0]);
        for (int i = 0; i < kBlocksPerSection; ++i) grown.set(i, values[static_cast<std::size_t>(i)]);
        EXPECT_GE(grown.memoryBytes(), own + c.words + 2 * c.palette);
        EXPECT_LE(grown.memoryBytes(), own + c.words + 2 * 2 * c.palette);
        grown.compact();
        EXPECT_EQ(grown.memoryBytes(), own + c.words + 2 * c.palette);
    }
}

TEST(Section, UnpackMappedLooksUpThePalette) {
    std::mt19937 random(6);
    for (const int distinct : {2, 3, 16, 17, 256}) {
        const Values values = valuesWith(distinct, random);
        const Section section = Section::fromValues(values);
        std::vector<Section::Value> mapped;
        for (const Section::Value value : section.palette())
            mapped.push_back(static_cast<Section::Value>(value / 3));
        Values result;
        section.unpackMapped(mapped, result);
        for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(result[i], values[i] / 3) << i;
    }
}

// Runs of all lengths and places, which fromValues compares four at a time.
TEST(Section, FromValuesWithRuns) {
    std::mt19937 random(7);
    for (int round = 0; round < 200; ++round) {
        Values values;
        for (std::size_t i = 0; i < values.size();) {
            const auto value = static_cast<Section::Value>(random() % 6 * 0x0101);
            for (std::size_t end = std::min(values.size(), i + 1 + random() % 40); i < end; ++i)
                values[i] = value;
        }
        expectSmallest(Section::fromValues(values), values);
        if (HasFatalFailure()) return;
    }
}

TEST(Section, EqualityIgnoresForm) {
    std::mt19937 random(4);
    const Values values = valuesWith(4, random);
    const Section narrow = Section::fromValues(values);
    Section wide = narrow;
    for (int i = 0; i < 300; ++i) wide.set(0, static_cast<Section::Value>(i));
    wide.set(0, values[0]);
    EXPECT_EQ(wide.bits(), 16);
    EXPECT_EQ(wide, narrow);
    EXPECT_EQ(narrow, wide);
    wide.set(4095, static_cast<Section::Value>(values[4095] + 1));
    EXPECT_FALSE(wide == narrow);

    EXPECT_EQ(Section(3), Section(3));
    EXPECT_FALSE(Section(3) == Section(4));
    Section formerlyMixed(3);
    formerlyMixed.set(9, 8);
    EXPECT_FALSE(formerlyMixed == Section(3));
    formerlyMixed.set(9, 3);
    EXPECT_EQ(formerlyMixed, Section(3));
}

TEST(Section, SurelyAllOfEachForm) {
    const auto isEven = [](Section::Value value) { return value % 2 == 0; };
    EXPECT_TRUE(Section(4).surelyAll(isEven));
    EXPECT_FALSE(Section(5).surelyAll(isEven));
    Section section(4);
    section.set(7, 6);
    EXPECT_TRUE(section.surelyAll(isEven));
    section.set(8, 3);
    EXPECT_FALSE(section.surelyAll(isEven));
    section.set(8, 4);
    EXPECT_FALSE(section.surelyAll(isEven)) << "the palette still has the odd value";
    section.compact();
    EXPECT_TRUE(section.surelyAll(isEven));
    for (int k = 0; k < 1000; ++k) section.set(k, static_cast<Section::Value>(2 * k));
    ASSERT_TRUE(section.isDense());
    EXPECT_FALSE(section.surelyAll(isEven)) << "dense sections are not searched";
}

TEST(Section, CopiesAreIndependent) {
    std::mt19937 random(5);
    for (const int distinct : {1, 2, 16, 200, 1000}) {
        const Values values = valuesWith(distinct, random);
        const Section original = Section::fromValues(values);
        Section copy = original;
        copy.set(17, static_cast<Section::Value>(values[17] + 1));
        EXPECT_EQ(unpacked(original), values);
        EXPECT_EQ(copy.get(17), static_cast<Section::Value>(values[17] + 1));
    }
}

TEST(Section, FromPackedTakesWhatAnotherShows) {
    std::array<Section::Value, kBlocksPerSection> values;
    for (const int distinct : {2, 3, 16, 17, 256, 257}) {
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<Section::Value>(i * 7 % static_cast<std::size_t>(distinct) * 5);
        const Section section = Section::fromValues(values);
        const auto copy = Section::fromPacked(section.bits(), section.palette(), section.words());
        ASSERT_TRUE(copy) << distinct;
        EXPECT_EQ(*copy, section);
        EXPECT_EQ(copy->bits(), section.bits());
    }
}

std::optional<Section> fromPacked(int bits, const std::vector<Section::Value>& palette,
                                  const std::vector<std::uint64_t>& words) {
    return Section::fromPacked(bits, palette, words);
}

TEST(Section, FromPackedRefusesIndicesWithoutAValue) {
    std::vector<std::uint64_t> words(128);
    words[127] = std::uint64_t{3} << 62;  // the last block has index 3
    EXPECT_TRUE(fromPacked(2, {1, 2, 3, 4}, words));
    EXPECT_FALSE(fromPacked(2, {1, 2, 3}, words));
    EXPECT_FALSE(fromPacked(2, {}, words));
    EXPECT_FALSE(fromPacked(2, {1, 2, 3, 4, 5}, words)) << "two bits tell four values apart";
    EXPECT_FALSE(fromPacked(16, {1}, std::vector<std::uint64_t>(1024))) << "dense has no palette";
}

TEST(Section, FromPackedRefusesOtherFormsAndNumbersOfWords) {
    for (const int bits : {-1, 0, 3, 5, 17, 64}) {
        EXPECT_FALSE(fromPacked(bits, {1, 2}, std::vector<std::uint64_t>(64))) << bits;
    }
    for (const std::size_t words : {0u, 63u, 65u}) {
        EXPECT_FALSE(fromPacked(1, {1, 2}, std::vector<std::uint64_t>(words))) << words;
    }
    EXPECT_TRUE(fromPacked(1, {1, 2}, std::vector<std::uint64_t>(64)));
}

// Random writes to copies of copies: each has the values that were written to it alone.
TEST(Section, CopiesShareTheirMemoryUntilOneIsWritten) {
    std::mt19937 random(7);
    std::vector<Pair> pairs(4);
    for (int round = 0; round < 3000; ++round) {
        Pair& pair = pairs[random() % pairs.size()];
        switch (random() % 8) {
            case 0: {
                const Pair& other = pairs[random() % pairs.size()];
                pair = other;
                ASSERT_TRUE(pair.section.isSame(other.section));
                break;
            }
            case 1:
                pair.section.compact();
                break;
            case 2:
                pair = Pair(std::move(pairs[random() % pairs.size()]));
                pair.plain = unpacked(pair.section);
                for (Pair& left : pairs) left.plain = unpacked(left.section);
                break;
            default:
                pair.writeRandomly(1 + static_cast<int>(random() % 40), 1 << random() % 10,
                                   static_cast<Section::Value>(random() % 5), random);
        }
        for (const Pair& each : pairs) ASSERT_EQ(unpacked(each.section), each.plain) << round;
    }
}

TEST(Section, IsSmallAndItsCopiesCostNothing) {
    static_assert(sizeof(Section) == 8);
    Section section(3);
    section.set(9, 4);
    const Section copy = section;
    EXPECT_TRUE(copy.isSame(section));
    EXPECT_EQ(copy.words().data(), section.words().data());
    section.set(9, 4);
    EXPECT_TRUE(copy.isSame(section)) << "nothing was changed";
    section.set(10, 4);
    EXPECT_FALSE(copy.isSame(section));
    EXPECT_EQ(copy.get(10), 3);
    EXPECT_TRUE(Section(5).isSame(Section(5)));
    EXPECT_FALSE(Section(5).isSame(Section(6)));
}

TEST(Section, UnpackMappedNeedsAValueForEachPaletteEntry) {
    Section section(3);
    section.set(9, 4);
    std::array<Section::Value, kBlocksPerSection> values;
    const std::array<Section::Value, 1> mapped = {7};
    EXPECT_THROW(section.unpackMapped(mapped, values), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::world
