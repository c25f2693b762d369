#include "terrane/formats/file_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "terrane/base/files.h"
#include "terrane/formats/nbt.h"
#include "tests/base/temp_folder.h"

namespace terrane::formats {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using testing::HasSubstr;

std::string nbt(std::string_view rootName, const NbtCompound& compound) {
    return encodeNbt({std::string(rootName), compound});
}

// A compound with an empty compound of each name.
NbtCompound compoundOf(const std::vector<std::string_view>& names) {
    NbtCompound compound;
    for (const std::string_view name : names) compound.add(name, {NbtCompound()});
    return compound;
}

std::string kindNameOf(std::string_view fileName, std::string_view bytes) {
    const FileKind* kind = kindOfFile(fileName, bytes);
    return kind ? std::string(kind->name) : "";
}

std::string formatOf(std::string_view bytes) {
    const FileKind* kind = kindOfFile("file", bytes);
    return kind ? std::string(kind->format) : "unknown";
}

TEST(FileKind, KnowsFilesByTheirFirstBytes) {
    const std::string tar = std::string(257, 'a') + "ustar";
    const std::string qubicle = "\x01\x01\0\0\0\0\0\0\x01\0\0\0\0\0\0\0\0\0\0\0\x02\0\0\0"s;
    const std::vector<std::pair<std::string, std::string_view>> examples{
        {"MTSM\0\x04\0\x01"s, "Luanti"},
        {"VOX \x96\0\0\0"s, "MagicaVoxel"},
        {qubicle, "Qubicle"},
        {"QB 2\0\x01"s, "Qubicle"},
        {"GOX \x02\0\0\0"s, "Goxel"},
        {"glTF\x02\0\0\0"s, "mesh"},
        {"# Blender\nmtllib a.mtl\nv 1 2 3\n", "mesh"},
        {"{\n \"asset\": {\"version\": \"2.0\"}}", "mesh"},
        {"\x89PNG\r\n\x1a\n", "image"},
        {"\xff\xd8\xff\xe0", "image"},
        {"PK\x03\x04level.dat", "zip"},
        {"7z\xbc\xaf\x27\x1c", "7z"},
        {"Rar!\x1a\x07\x01", "archive"},
        {"\x28\xb5\x2f\xfd", "zstd"},
        {"\xfd"
         "7zXZ\0"s,
         "xz"},
        {tar, "tar"},
        {"SQLite format 3\0"s, "SQLite"},
        {"TerrStru", "Terrane"},
        {"\x93NUMPY\x01\0"s, "NumPy"},
        {"<!DOCTYPE html><html>", "web page"},
        {"", "empty"},
    };
    for (const auto& [bytes, name] : examples) {
        EXPECT_THAT(kindNameOf("a.schem", bytes), HasSubstr(std::string(name)));
        EXPECT_EQ(formatOf(bytes), name == "MagicaVoxel" ? "vox" : "") << name;
    }
    EXPECT_EQ(kindOfFile("a.schem", "any text"), nullptr);
    EXPECT_EQ(kindOfFile("a.schem", "\0\0\0\0"s), nullptr);
}

TEST(FileKind, KnowsCompressedFilesByWhatTheyHold) {
    const std::vector<std::pair<std::string, std::string_view>> examples{
        {nbt("Schematic", compoundOf({"Version", "Palette", "BlockData"})), "schem"},
        {nbt("", compoundOf({"Schematic"})), "schem"},
        {nbt("Schematic", compoundOf({"Blocks", "Materials"})), "schem"},
        {nbt("", compoundOf({"Metadata", "Regions", "Version"})), "Litematica"},
        {nbt("", compoundOf({"size", "palette", "blocks", "entities"})), "structure file"},
        {nbt("", compoundOf({"Data"})), "level.dat"},
        {nbt("MinecraftLevel", compoundOf({"Map"})), "Indev"},
        {nbt("ClassicWorld", compoundOf({"BlockArray"})), "ClassicWorld"},
        {nbt("", compoundOf({"something"})), "NBT"},
        {"\x27\x1b\xb7\x88\x02\xac\xed", "Classic"},
        {std::string(257, 'a') + "ustar", "tar"},
        {"any text", "gzip"},
    };
    for (const auto& [bytes, name] : examples) {
        const std::string file = gzip(bytes);
        const bool isSchematic = name == "schem", isNbt = bytes[0] == '\x0a';
        EXPECT_EQ(formatOf(file), isSchematic ? "schem" : "") << bytes;
        EXPECT_THAT(kindNameOf("a", file), HasSubstr(isSchematic ? "schematic" : std::string(name)));
        EXPECT_TRUE(!isNbt || kindOfFile("a", bytes) == kindOfFile("a", file)) << name << ", not compressed";
    }
    // The names before a large part are enough: only the file's beginning is read.
    NbtCompound large;
    large.add("Regions", {NbtBytes{std::string(100'000, 'x')}});
    const std::string file = nbt("", large);
    EXPECT_THAT(kindNameOf("a", std::string_view(file).substr(0, 50'000)), HasSubstr("Litematica"));
    // Any beginning of a file has some kind, or none.
    for (std::size_t size = 0; size < 200; ++size)
        (void)kindOfFile("a", std::string_view(examples[1].first).substr(0, size));
}

TEST(FileKind, KnowsBedrock) {
    EXPECT_THAT(kindNameOf("a.mcworld", "PK\x03\x04"), HasSubstr("Bedrock"));
    EXPECT_THAT(kindNameOf("A.MCWORLD", "PK\x03\x04"), HasSubstr("Bedrock"));
    EXPECT_THAT(kindNameOf("a.zip", "PK\x03\x04.. db/CURRENT .."), HasSubstr("Bedrock"));
    EXPECT_THAT(kindNameOf("a.zip", "PK\x03\x04.. Home/region/r.0.0.mca"), HasSubstr("zip"));
    EXPECT_THAT(kindNameOf("a.mcstructure",
                           "\x0a\0\0\x03\x0e\0format_version\x01\0\0\0\x09\x16\0structure_world_origin"s),
                HasSubstr("Bedrock"));
    EXPECT_THAT(kindNameOf("level.dat", "\x0a\0\0\0\x10\0\0\0\x0a\0\0\x08\x0d\0"s), HasSubstr("Bedrock"));
}

TEST(FileKind, KnowsRegionFilesByTheirNames) {
    EXPECT_EQ(kindOfFile("r.0.-1.mca", "\0\0\x02\x01"s)->format, "minecraft");
    EXPECT_THAT(kindNameOf("r.0.-1.mcr", "\0\0\x02\x01"s), HasSubstr("Beta"));
    EXPECT_THAT(kindNameOf("r.0.0.mca", "<html>"), HasSubstr("web page"));
}

TEST(FileKind, KnowsFolders) {
    const base::TempFolder folder;
    const auto make = [&](const std::string& file) {
        fs::create_directories((folder.path() / file).parent_path());
        std::ofstream(folder.path() / file) << "x";
    };
    for (const char* file :
         {"bedrock/db/CURRENT", "bedrock/db/MANIFEST-000001", "luanti/world.mt", "beta/region/r.0.0.mcr",
          "beta2/r.0.0.mcr", "alpha/level.dat", "alpha/1k/c/c.-1.0.dat", "java/level.dat",
          "java/region/r.0.0.mca", "new/dimensions/minecraft/overworld/region/r.0.0.mca", "other/readme.txt"})
        make(file);
    const auto nameOf = [&](const char* name) {
        const FileKind* kind = kindOfFolder(folder / name);
        return kind ? std::string(kind->name) : "";
    };
    EXPECT_THAT(nameOf("bedrock"), HasSubstr("Bedrock"));
    EXPECT_THAT(nameOf("bedrock/db"), HasSubstr("Bedrock"));
    EXPECT_THAT(nameOf("luanti"), HasSubstr("Luanti"));
    EXPECT_THAT(nameOf("beta"), HasSubstr("Beta"));
    EXPECT_THAT(nameOf("beta2"), HasSubstr("Beta"));
    EXPECT_THAT(nameOf("alpha"), HasSubstr("Alpha"));
    EXPECT_EQ(kindOfFolder(folder / "java")->format, "minecraft");
    EXPECT_EQ(kindOfFolder(folder / "new")->format, "minecraft");
    EXPECT_EQ(nameOf("other"), "");
    EXPECT_EQ(nameOf("missing"), "");
}

TEST(FileKind, ExplainsErrors) {
    const base::TempFolder folder;
    const fs::path file = folder / "island.schem";
    ASSERT_TRUE(base::writeFile(file, "MTSM\0\x04"s));
    const base::Error damaged{base::ErrorCode::Damaged, "island.schem: it is damaged"};
    const base::Error told = explained(file, "schem", damaged);
    EXPECT_EQ(told.code, base::ErrorCode::Unsupported);
    EXPECT_THAT(told.message, HasSubstr(file.string() + ": this is a schematic of Luanti"));
    EXPECT_THAT(told.message, HasSubstr("can be imported"));
    ASSERT_TRUE(base::writeFile(file, "VOX "));
    EXPECT_THAT(explained(file, "schem", damaged).message, HasSubstr("`terrane import vox`"));
    EXPECT_EQ(explained(file, "vox", damaged).message, damaged.message);
    ASSERT_TRUE(base::writeFile(file, "nothing known"));
    EXPECT_EQ(explained(file, "schem", damaged).message, damaged.message);
    EXPECT_EQ(explained(folder / "missing", "schem", damaged).message, damaged.message);
    fs::create_directories(folder / "w/db");
    ASSERT_TRUE(base::writeFile(folder / "w/db/CURRENT", "MANIFEST-000001\n"));
    EXPECT_THAT(explained(folder / "w", "minecraft", damaged).message, HasSubstr("Bedrock"));
}

}  // namespace
}  // namespace terrane::formats
