#include "terrane/formats/schematic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "terrane/content/built_in.h"
#include "terrane/formats/nbt.h"

namespace terrane::formats {
namespace {

using testing::HasSubstr;

NamedVolume randomVolume(std::mt19937& random) {
    NamedVolume volume;
    for (int axis = 0; axis < 3; ++axis) volume.size[axis] = 1 + static_cast<int>(random() % 12);
    const std::size_t names = 1 + random() % 300;
    for (std::size_t k = 0; k < names; ++k) {
        NamedState state{"minecraft:b" + std::to_string(k / 2), {}};
        if (k % 2 == 1) state.properties = {{"a", "x"}, {"half", std::to_string(k)}};
        volume.palette.push_back(state);
    }
    volume.cells.resize(static_cast<std::size_t>(volume.size.x * volume.size.y * volume.size.z));
    for (std::uint16_t& cell : volume.cells) cell = static_cast<std::uint16_t>(random() % names);
    return volume;
}

// Names cell by cell: palettes may differ.
std::vector<std::string> namesOf(const NamedVolume& volume) {
    std::vector<std::string> names;
    for (const std::uint16_t cell : volume.cells) names.push_back(textOf(volume.palette[cell]));
    return names;
}

std::string schematicError(std::string_view bytes) {
    const auto volume = decodeSchematic(bytes, LegacyIds());
    return volume ? "" : volume.error().message;
}

// 2×1×2 of Minecraft's axes: width, height, length.
NbtCompound small(std::int32_t version) {
    NbtCompound schematic, palette, blocks;
    schematic.add("Version", {version}).add("Width", {std::int16_t{2}}).add("Height", {std::int16_t{1}});
    schematic.add("Length", {std::int16_t{2}});
    palette.add("minecraft:air", {std::int32_t{0}}).add("minecraft:stone", {std::int32_t{200}});
    const NbtBytes data{std::string("\0\xc8\x01\0\0", 5)};  // x 1, z 0 is stone
    if (version != 3) return schematic.add("Palette", {palette}).add("BlockData", {data});
    return schematic.add("Blocks", {blocks.add("Palette", {palette}).add("Data", {data})});
}

std::string fileOf(const NbtCompound& schematic, bool isNested) {
    if (!isNested) return gzip(encodeNbt({"Schematic", schematic}));
    NbtCompound root;
    return gzip(encodeNbt({"", root.add("Schematic", {schematic})}));
}

TEST(Schematic, ComesBackTheSameForRandomVolumes) {
    std::mt19937 random(5);
    for (int round = 0; round < 40; ++round) {
        const NamedVolume volume = randomVolume(random);
        const auto bytes = encodeSchematic(volume);
        ASSERT_TRUE(bytes) << bytes.error().message;
        const auto back = decodeSchematic(*bytes, LegacyIds());
        ASSERT_TRUE(back) << back.error().message;
        EXPECT_EQ(back->size, volume.size);
        ASSERT_EQ(namesOf(*back), namesOf(volume)) << "round " << round;
    }
}

TEST(Schematic, BlocksComeBackTheSame) {
    const world::BlockRegistry blocks = *content::loadBlocks();
    const BlockMapping mapping = *loadMapping(blocks, {});
    std::mt19937 random(6);
    BlockVolume volume{{20, 20, 20}, {}, std::vector<std::uint16_t>(8000)};
    for (int k = 0; k < 700; ++k)
        volume.palette.push_back({static_cast<world::BlockId>(random() % blocks.types().size()),
                                  static_cast<std::uint16_t>(random() % 3 == 0 ? random() % 256 : 0)});
    for (std::uint16_t& cell : volume.cells) cell = static_cast<std::uint16_t>(random() % 700);
    const auto read = decodeSchematic(*encodeSchematic(toNames(volume, mapping)), LegacyIds());
    ASSERT_TRUE(read) << read.error().message;
    ImportCounts counts;
    const BlockVolume back = toBlocks(*read, mapping, counts);
    for (std::size_t k = 0; k < volume.cells.size(); ++k)
        ASSERT_EQ(back.palette[back.cells[k]], volume.palette[volume.cells[k]]) << k;
    EXPECT_TRUE(counts.unknown.empty());
}

TEST(Schematic, ReadsEachVersion) {
    for (const auto& [version, isNested] : {std::pair(1, false), {2, false}, {2, true}, {3, true}}) {
        const auto volume = decodeSchematic(fileOf(small(version), isNested), LegacyIds());
        ASSERT_TRUE(volume) << version << volume.error().message;
        EXPECT_EQ(volume->size, glm::ivec3(2, 2, 1));
        // The file's x 1 is our x 0.
        EXPECT_EQ(namesOf(*volume), (std::vector<std::string>{"minecraft:stone", "minecraft:air",
                                                              "minecraft:air", "minecraft:air"}));
    }
}

TEST(Schematic, ReadsNumbers) {
    const LegacyIds ids = *LegacyIds::parse("[ids]\n0 = 'air'\n1 = ['stone', 'granite']\n256 = 'mod'", "t");
    NbtCompound schematic;
    schematic.add("Width", {std::int16_t{3}})
        .add("Height", {std::int16_t{1}})
        .add("Length", {std::int16_t{1}});
    schematic.add("Blocks", {NbtBytes{std::string("\1\1\0", 3)}})
        .add("Data", {NbtBytes{std::string("\0\1\0", 3)}});
    schematic.add("AddBlocks", {NbtBytes{std::string("\0\x10", 2)}});
    const auto volume = decodeSchematic(fileOf(schematic, false), ids);
    ASSERT_TRUE(volume) << volume.error().message;
    EXPECT_EQ(namesOf(*volume),
              (std::vector<std::string>{"minecraft:mod", "minecraft:granite", "minecraft:stone"}));
}

TEST(Schematic, TellsWhatIsWrong) {
    EXPECT_THAT(schematicError("no gzip"), HasSubstr("damaged"));
    EXPECT_THAT(schematicError(fileOf(small(4), false)), HasSubstr("version 4"));
    EXPECT_THAT(schematicError(fileOf(NbtCompound(), false)), HasSubstr("no version"));
    NbtCompound large = small(2);
    for (NbtEntry& entry : large.entries)
        if (entry.name == "Width" || entry.name == "Height" || entry.name == "Length")
            entry.tag = {std::int16_t{-1}};
    EXPECT_THAT(schematicError(fileOf(large, false)), HasSubstr("larger than"));
    NbtCompound few = small(2);
    few.entries[1].tag = {std::int16_t{3}};
    EXPECT_THAT(schematicError(fileOf(few, false)), HasSubstr("too few blocks"));
    NbtCompound without = small(2);
    std::erase_if(without.entries, [](const NbtEntry& entry) { return entry.name == "Palette"; });
    EXPECT_THAT(schematicError(fileOf(without, false)), HasSubstr("missing"));
    NbtCompound other = small(2);
    for (NbtEntry& entry : other.entries)
        if (entry.name == "Palette") entry.tag = {NbtCompound()};
    EXPECT_THAT(schematicError(fileOf(other, false)), HasSubstr("no entry"));
    const std::string whole = fileOf(small(2), false);
    for (std::size_t size = 0; size < whole.size() - 8; ++size)
        ASSERT_NE(schematicError(whole.substr(0, size)), "") << size;
}

TEST(BlockVolume, BecomesAStructureOfDifferentBlocks) {
    const world::BlockRegistry blocks = *content::loadBlocks();
    const world::BlockId stone = blocks.find("stone")->id;
    const BlockVolume volume{{2, 1, 2}, {{0, 0}, {stone, 0}, {stone, 0}, {stone, 3}}, {1, 0, 2, 3}};
    const auto structure = toStructure(volume, blocks);
    ASSERT_TRUE(structure);
    EXPECT_EQ(structure->cells, (std::vector<std::uint32_t>{0, 1, 0, 2}));
    EXPECT_EQ(structure->palette[2], (world::StructureBlock{"stone", 3}));
    EXPECT_FALSE(toStructure({{1, 1, 4097}, {{0, 0}}, std::vector<std::uint16_t>(4097)}, blocks));
    EXPECT_FALSE(checkVolumeSize(0, 1, 1));
    EXPECT_FALSE(checkVolumeSize(INT64_MAX, INT64_MAX, INT64_MAX));
    EXPECT_TRUE(checkVolumeSize(kMaxVolumeBlocks, 1, 1));
}

}  // namespace
}  // namespace terrane::formats
