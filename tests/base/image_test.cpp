#include "terrane/base/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temp_folder.h"
#include "terrane/base/files.h"

namespace terrane::base {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

// Every byte differs from its neighbors; alpha takes all values, 0 with a color included.
Image someImage(int width, int height) {
    Image image{width, height, {}};
    for (int i = 0; i < width * height * 4; ++i)
        image.rgba.push_back(static_cast<std::uint8_t>(i * 37 + i / 256));
    return image;
}

void expectEqual(const Image& a, const Image& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.rgba, b.rgba);
}

std::string fromHex(std::string_view hex) {
    std::string bytes;
    for (std::size_t i = 0; i < hex.size(); i += 2) {
        bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
    }
    return bytes;
}

// 2 × 1 pixels with one bit each into a palette of red and blue.
std::string palettePng() {
    return fromHex(
        "89504e470d0a1a0a0000000d4948445200000002000000010103000000ceecedc9"
        "00000006504c5445ff00000000ff6ca1fd8e0000000a4944415478da6370"
        "00000042004184bf8e620000000049454e44ae426082");
}

// A header with 100,000 × 100,000 pixels in 69 bytes.
std::string hugePng() {
    return fromHex(
        "89504e470d0a1a0a0000000d49484452000186a0000186a00806000000a8520bc8"
        "0000000c4944415478da6360a03d000000640001b899ef990000000049454e44ae426082");
}

TEST(Image, RoundTripKeepsEveryByte) {
    for (const auto& [width, height] :
         {std::pair(1, 1), std::pair(7, 3), std::pair(3, 200), std::pair(64, 64)}) {
        const Image image = someImage(width, height);
        const Result<std::string> bytes = encodePng(image);
        ASSERT_TRUE(bytes);
        EXPECT_THAT(*bytes, StartsWith("\x89PNG"));
        const Result<Image> back = decodePng(*bytes, "memory");
        ASSERT_TRUE(back) << back.error().message;
        expectEqual(*back, image);
    }
}

TEST(Image, RowZeroIsTheTop) {
    // 1 × 2: a PNG stores its top row first, and so does the image.
    const Image image{1, 2, {255, 0, 0, 255, 0, 0, 255, 255}};
    const Image back = decodePng(encodePng(image).value(), "memory").value();
    EXPECT_THAT(back.rgba, ElementsAre(255, 0, 0, 255, 0, 0, 255, 255));
}

TEST(Image, OtherKindsOfPngBecomeRgba) {
    const Result<Image> image = decodePng(palettePng(), "palette");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, 2);
    EXPECT_EQ(image->height, 1);
    EXPECT_THAT(image->rgba, ElementsAre(255, 0, 0, 255, 0, 0, 255, 255));
}

TEST(Image, EveryTruncationIsAnErrorThatNamesTheFile) {
    for (const std::string& bytes : {encodePng(someImage(19, 11)).value(), palettePng()}) {
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            // Memory of exactly that size, so that the address sanitizer sees a read past it.
            const std::vector<char> part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
            const Result<Image> image = decodePng({part.data(), part.size()}, "textures/stone.png");
            ASSERT_FALSE(image) << size << " of " << bytes.size() << " bytes";
            EXPECT_THAT(image.error().message, StartsWith("textures/stone.png: cannot be read as PNG: "));
        }
    }
}

TEST(Image, FlippedBitsNeverCrash) {
    const std::string good = encodePng(someImage(9, 5)).value();
    int errorCount = 0;
    for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
        std::string bad = good;
        bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << (bit % 8)));
        const Result<Image> image = decodePng(bad, "bad.png");
        if (!image) {
            ++errorCount;
            EXPECT_THAT(image.error().message, StartsWith("bad.png: "));
        }
    }
    EXPECT_GT(errorCount, 100);
}

TEST(Image, OtherBytesAreAnError) {
    for (const std::string& bytes : {std::string(), std::string("P6 1 1 255 abc"), std::string(1000, '\0')}) {
        EXPECT_FALSE(decodePng(bytes, "x"));
    }
}

TEST(Image, MorePixelsThanAllowedAreAnError) {
    const Result<Image> image = decodePng(hugePng(), "huge.png");
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().message, "huge.png: 100000 × 100000 pixels are more than the 67108864 allowed");
}

TEST(Image, FilesRoundTrip) {
    const TempFolder folder;
    const Image image = someImage(5, 4);
    ASSERT_TRUE(writePng(folder / "a.png", image));
    EXPECT_TRUE(readPng(folder / "a.png", 20));
    EXPECT_FALSE(readPng(folder / "a.png", 19));
    const Result<Image> back = readPng(folder / "a.png");
    ASSERT_TRUE(back);
    expectEqual(*back, image);
}

TEST(Image, FileErrorsNameThePath) {
    const TempFolder folder;
    ASSERT_TRUE(writeFile(folder / "text.png", "hello"));
    const std::string textPath = (folder / "text.png").string();
    EXPECT_THAT(readPng(textPath).error().message, StartsWith(textPath + ": cannot be read as PNG: "));
    EXPECT_EQ(readPng("no/such.png").error().message,
              "no/such.png: cannot be read: No such file or directory");
    EXPECT_EQ(writePng("no/such.png", someImage(1, 1)).error().message,
              "no/such.png: cannot be written: No such file or directory");
}

TEST(Image, OnlyAnImageWithAllItsBytesBecomesAPng) {
    for (const auto& encode : {encodePng, encodePngFast}) {
        EXPECT_EQ(encode(Image{}).error().message, "an image of 0 × 0 pixels cannot be a PNG");
        EXPECT_EQ(
            encode(Image{.width = 2, .height = 2, .rgba = std::vector<std::uint8_t>(15)}).error().message,
            "an image of 2 × 2 pixels has 15 bytes, expected 4 per pixel");
        EXPECT_TRUE(encode(Image{.width = 2, .height = 2, .rgba = std::vector<std::uint8_t>(16)}));
    }
}

}  // namespace
}  // namespace terrane::base
