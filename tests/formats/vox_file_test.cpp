#include "terrane/formats/vox_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "terrane/content/built_in.h"
#include "terrane/formats/vox_file_internal.h"

namespace terrane::formats {
namespace {

using testing::HasSubstr;

VoxImage randomImage(std::mt19937& random, glm::ivec3 size, unsigned sparse) {
    VoxImage image;
    image.size = size;
    for (std::size_t k = 1; k < 256; ++k) image.colors[k] = static_cast<std::uint32_t>(random()) | 0xff;
    image.cells.resize(static_cast<std::size_t>(size.x * size.y * size.z));
    for (std::uint8_t& cell : image.cells)
        cell = static_cast<std::uint8_t>(random() % sparse == 0 ? random() % 256 : 0);
    return image;
}

std::string voxError(std::string_view bytes) {
    const auto image = decodeVox(bytes);
    return image ? "" : image.error().message;
}

std::string voxNumber(std::int32_t value) {
    std::string bytes;
    for (unsigned k = 0; k < 4; ++k) bytes.push_back(static_cast<char>(value >> (8 * k)));
    return bytes;
}

std::string voxText(std::string_view value) {
    return voxNumber(static_cast<std::int32_t>(value.size())) + std::string(value);
}

std::string voxPart(std::string_view kind, const std::string& content) {
    return std::string(kind) + voxNumber(static_cast<std::int32_t>(content.size())) + voxNumber(0) + content;
}

std::string voxFile(const std::string& parts) {
    return "VOX " + voxNumber(150) + "MAIN" + voxNumber(0) +
           voxNumber(static_cast<std::int32_t>(parts.size())) + parts;
}

// 3×2×1 with a voxel of color 7 at 2,0,0.
std::string model() {
    return voxPart("SIZE", voxNumber(3) + voxNumber(2) + voxNumber(1)) +
           voxPart("XYZI", voxNumber(1) + std::string("\2\0\0\7", 4));
}

std::string transform(int id, int child, const std::string& attributes, const std::string& frame) {
    return voxPart("nTRN", voxNumber(id) + attributes + voxNumber(child) + voxNumber(-1) + voxNumber(0) +
                               voxNumber(1) + frame);
}

std::string shape(int id, int of) {
    return voxPart("nSHP", voxNumber(id) + voxNumber(0) + voxNumber(1) + voxNumber(of) + voxNumber(0));
}

TEST(VoxFile, ComesBackTheSameForRandomVolumes) {
    std::mt19937 random(9);
    for (const glm::ivec3 size : {glm::ivec3(1), glm::ivec3(7, 3, 5), glm::ivec3(40, 30, 20),
                                  glm::ivec3(256, 3, 2), glm::ivec3(300, 4, 5), glm::ivec3(3, 600, 270)}) {
        const VoxImage image = randomImage(random, size, 2 + static_cast<unsigned>(random() % 5));
        const auto back = decodeVox(encodeVox(image));
        ASSERT_TRUE(back) << back.error().message;
        ASSERT_EQ(*back, image) << size.x;
    }
}

// Ends of the parts in a file, in bytes from its start.
std::set<std::size_t> partEnds(std::string_view file) {
    constexpr std::size_t kFileHead = 20, kPartHead = 12;
    std::set<std::size_t> ends;
    for (std::size_t at = kFileHead; at + kPartHead <= file.size();) {
        std::size_t size = 0;
        for (std::size_t k = 0; k < 4; ++k)
            size |= std::size_t{static_cast<std::uint8_t>(file[at + 4 + k])} << (8 * k);
        at += kPartHead + size;
        ends.insert(at);
    }
    return ends;
}

TEST(VoxFile, RefusesEveryTruncation) {
    std::mt19937 random(2);
    const std::string bytes = encodeVox(randomImage(random, {5, 300, 2}, 40));
    const std::set<std::size_t> ends = partEnds(bytes);
    ASSERT_TRUE(ends.contains(bytes.size()));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const auto image = decodeVox(bytes.substr(0, size));
        // A file that ends between two parts is read if it has a model, and all nodes of a scene or none.
        if (image) {
            ASSERT_TRUE(ends.contains(size)) << size;
        } else {
            ASSERT_NE(image.error().message, "") << size;
        }
    }
    EXPECT_THAT(voxError(bytes.substr(0, bytes.size() - 1)), HasSubstr("cut off"));
    EXPECT_THAT(voxError(bytes.substr(0, 30)), HasSubstr("cut off"));
}

TEST(VoxFile, HasADefaultPalette) {
    const auto colors = defaultVoxColors();
    EXPECT_EQ(colors[1], 0xffffffffu);
    EXPECT_EQ(colors[2], 0xffffccffu);
    EXPECT_EQ(colors[7], 0xffccffffu);
    EXPECT_EQ(colors[215], 0x000033ffu);
    EXPECT_EQ(colors[216], 0xee0000ffu);
    EXPECT_EQ(colors[255], 0x111111ffu);
    EXPECT_EQ(decodeVox(voxFile(model()))->colors, colors);
}

TEST(VoxFile, PlacesModelsOfTheScene) {
    // The model as it is, and moved by 10 and turned: x becomes y, y becomes -x (a quarter counterclockwise).
    const std::string quarter =
        voxNumber(2) + voxText("_r") + voxText("17") + voxText("_t") + voxText("10 0 0");
    const std::string parts =
        model() + transform(0, 1, voxNumber(0), voxNumber(0)) +
        voxPart("nGRP", voxNumber(1) + voxNumber(0) + voxNumber(2) + voxNumber(2) + voxNumber(4)) +
        transform(2, 3, voxNumber(0), voxNumber(0)) + shape(3, 0) + transform(4, 5, voxNumber(0), quarter) +
        shape(5, 0);
    const auto image = decodeVox(voxFile(parts));
    ASSERT_TRUE(image) << image.error().message;
    std::vector<glm::ivec3> found;
    for (int k = 0; k < static_cast<int>(image->cells.size()); ++k)
        if (image->cells[static_cast<std::size_t>(k)] == 7)
            found.push_back(
                {k % image->size.x, k / image->size.x % image->size.y, k / image->size.x / image->size.y});
    ASSERT_EQ(found.size(), 2u);
    // Both models turn about 1,1,0. As it is: 2,0 - 1,1 = 1,-1. Turned: its middle 1.5,-0.5 becomes 0.5,1.5.
    EXPECT_EQ(found[1] - found[0], glm::ivec3(10 - 1, 1 + 1, 0));
}

TEST(VoxFile, LeavesOutWhatIsHidden) {
    const std::string hidden = voxNumber(1) + voxText("_hidden") + voxText("1");
    const auto scene = [&](const std::string& attributes) {
        return voxFile(model() + transform(0, 1, attributes, voxNumber(0)) + shape(1, 0));
    };
    EXPECT_EQ(voxError(scene(voxNumber(0))), "");
    EXPECT_THAT(voxError(scene(hidden)), HasSubstr("no model"));
}

// A part LAYR has its number, attributes and a reserved number. The transform is in layer 0.
TEST(VoxFile, LeavesOutHiddenLayers) {
    const std::string hidden = voxNumber(1) + voxText("_hidden") + voxText("1");
    const auto scene = [&](int layer, const std::string& attributes) {
        return voxFile(model() + transform(0, 1, voxNumber(0), voxNumber(0)) + shape(1, 0) +
                       voxPart("LAYR", voxNumber(layer) + attributes + voxNumber(-1)));
    };
    EXPECT_EQ(voxError(scene(0, voxNumber(0))), "");
    EXPECT_EQ(voxError(scene(1, hidden)), "");
    EXPECT_THAT(voxError(scene(0, hidden)), HasSubstr("no model"));
}

TEST(VoxFile, TellsWhatIsWrong) {
    EXPECT_THAT(voxError("VOXX"), HasSubstr("header"));
    EXPECT_THAT(voxError(voxFile("")), HasSubstr("no model"));
    EXPECT_THAT(voxError(voxFile(voxPart("SIZE", voxNumber(0) + voxNumber(1) + voxNumber(1)))),
                HasSubstr("0 blocks per side"));
    EXPECT_THAT(voxError(voxFile(voxPart("XYZI", voxNumber(0)))), HasSubstr("no size"));
    EXPECT_THAT(voxError(voxFile(voxPart("SIZE", voxNumber(1) + voxNumber(1) + voxNumber(1)) +
                                 voxPart("XYZI", voxNumber(1) + std::string("\1\0\0\1", 4)))),
                HasSubstr("outside its model"));
    EXPECT_THAT(voxError(voxFile(model() + transform(0, 0, voxNumber(0), voxNumber(0)))),
                HasSubstr("too deep"));
    EXPECT_THAT(voxError(voxFile(model() + transform(0, 5, voxNumber(0), voxNumber(0)))),
                HasSubstr("missing"));
    EXPECT_THAT(voxError(voxFile(model() + transform(0, 1, voxNumber(0), voxNumber(0)) + shape(1, 9))),
                HasSubstr("missing"));
    EXPECT_THAT(voxError(voxFile(model() +
                                 transform(0, 1, voxNumber(0), voxNumber(1) + voxText("_r") + voxText("5")))),
                HasSubstr("rotation"));
    for (const char* step : {"99999999999 0 0", "0 2147483647", "0 0 -1048577", "nan", "1 x", "1.5 0 0"})
        EXPECT_THAT(
            voxError(voxFile(model() +
                             transform(0, 1, voxNumber(0), voxNumber(1) + voxText("_t") + voxText(step)) +
                             shape(1, 0))),
            HasSubstr("translation"))
            << step;
    const std::string far = voxNumber(1) + voxText("_t") + voxText("1000000 0 0");
    EXPECT_THAT(voxError(voxFile(model() +
                                 voxPart("nGRP", voxNumber(0) + voxNumber(0) + voxNumber(2) + voxNumber(1) +
                                                     voxNumber(3)) +
                                 transform(1, 2, voxNumber(0), far) + shape(2, 0) +
                                 transform(3, 4, voxNumber(0), voxNumber(0)) + shape(4, 0))),
                "");
    const std::string farUp = voxNumber(1) + voxText("_t") + voxText("1000000 0 1000000");
    EXPECT_THAT(
        voxError(voxFile(
            model() +
            voxPart("nGRP", voxNumber(0) + voxNumber(0) + voxNumber(2) + voxNumber(1) + voxNumber(3)) +
            transform(1, 2, voxNumber(0), voxNumber(1) + voxText("_t") + voxText("900000 900000 9")) +
            shape(2, 0) + transform(3, 4, voxNumber(0), farUp) + shape(4, 0))),
        HasSubstr("larger than"));
}

// Groups that hold the next one twice: 2^60 shapes.
TEST(VoxFile, EndsOnScenesThatGrow) {
    std::string parts = model();
    for (int k = 0; k < 60; ++k)
        parts +=
            voxPart("nGRP", voxNumber(k) + voxNumber(0) + voxNumber(2) + voxNumber(k + 1) + voxNumber(k + 1));
    EXPECT_THAT(voxError(voxFile(parts + shape(60, 0))), HasSubstr("too large"));
}

TEST(VoxBlocks, ColorsOfBlocksComeBack) {
    const world::BlockRegistry blocks = *content::loadBlocks();
    const auto tops = world::topColors(blocks, content::builtInTextures());
    ASSERT_TRUE(tops);
    const BlockMapping mapping = *loadMapping(blocks, {});
    BlockVolume volume{{1, 1, 0}, {}, {}};
    for (const world::BlockType& type : blocks.types()) {
        if (!type.opaqueCube || (*tops)[type.id].tinted || type.id == blocks.missing()) continue;
        volume.cells.push_back(static_cast<std::uint16_t>(volume.palette.size()));
        volume.palette.push_back({type.id, 0});
        ++volume.size.z;
    }
    const auto image = toVox(volume, *tops);
    ASSERT_TRUE(image) << image.error().message;
    const BlockVolume back = toBlocks(*decodeVox(encodeVox(*image)), mapping, blocks, *tops);
    int same = 0;
    for (std::size_t k = 0; k < volume.cells.size(); ++k) {
        const world::BlockId before = volume.palette[volume.cells[k]].id,
                             after = back.palette[back.cells[k]].id;
        EXPECT_LT(glm::distance((*tops)[before].mean, (*tops)[after].mean), 1.8f) << blocks.type(before).name;
        same += before == after ? 1 : 0;
    }
    EXPECT_GT(same, 60);
}

}  // namespace
}  // namespace terrane::formats
