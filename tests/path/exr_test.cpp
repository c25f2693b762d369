#include "terrane/path/exr.h"

#include <gtest/gtest.h>

#if TERRANE_HAS_EXR
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include <array>
#endif

namespace terrane::path {
namespace {

Means twoPixels() {
    Means means;
    means.size = {2, 1};
    means.radiance = {{1, 2, 3}, {4e5f, 5, 1e-7f}};
    means.albedo = {{.1f, .2f, .3f}, {.4f, .5f, .6f}};
    means.normal = {{0, 0, 1}, {-1, 0, 0}};
    means.depth = {12.5f, 0};
    means.variance = {0.25f, 0.5f};
    return means;
}

#if TERRANE_HAS_EXR
TEST(ExrTest, FilesHaveAllChannels) {
    const auto path = std::filesystem::temp_directory_path() / "terrane_exr_test.exr";
    ASSERT_TRUE(hasExr());
    ASSERT_TRUE(writeExr(path, twoPixels(), {.samples = 7, .isDenoised = true}));
    Imf::InputFile file(path.c_str());
    EXPECT_NE(file.header().findTypedAttribute<Imf::StringAttribute>("comments"), nullptr);
    const auto read = [&](const char* name) {
        std::array<float, 2> values{};
        Imf::FrameBuffer buffer;
        buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), 0));
        file.setFrameBuffer(buffer);
        file.readPixels(0);
        return values;
    };
    EXPECT_EQ(read("R"), (std::array{1.0f, 4e5f}));
    EXPECT_EQ(read("B"), (std::array{3.0f, 1e-7f}));
    EXPECT_EQ(read("albedo.G"), (std::array{.2f, .5f}));
    EXPECT_EQ(read("normal.X"), (std::array{0.0f, -1.0f}));
    EXPECT_EQ(read("Z"), (std::array{12.5f, 0.0f}));
    EXPECT_EQ(read("variance"), (std::array{0.25f, 0.5f}));
    std::filesystem::remove(path);
}

TEST(ExrTest, AFolderThatIsNotThereIsAnError) {
    EXPECT_FALSE(writeExr("/nowhere/at/all.exr", twoPixels(), {}));
}
#else
TEST(ExrTest, WithoutTheLibraryNothingIsWritten) {
    EXPECT_FALSE(hasExr());
    EXPECT_EQ(writeExr("image.exr", twoPixels(), {}).error().code, base::ErrorCode::Unsupported);
}
#endif

}  // namespace
}  // namespace terrane::path
