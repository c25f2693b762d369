#include "terrane/gpu/shader_loader.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <utility>

#include "terrane/base/files.h"
#include "tests/gpu/scratch_folder.h"

namespace terrane::gpu {
namespace {

constexpr std::array<base::EmbeddedFile, 2> kTwoFiles = {
    {{"terrane/a.glsl", "#include \"terrane/b.h\"\n"}, {"terrane/b.h", "embedded\n"}}};

TEST(ShaderLoaderTest, loadsEmbeddedFiles) {
    const ShaderLoader loader(kTwoFiles);
    const base::Result<ShaderSource> source =
        loader.load("terrane/a.glsl", ShaderStage::Compute, {{"A", "2"}});
    ASSERT_TRUE(source) << source.error().message;
    EXPECT_EQ(source->text, "#version 450 core\n#define A 2\n#line 1 0\n#line 1 1\nembedded\n#line 2 0\n");
    EXPECT_EQ(loader.load("terrane/c.glsl", ShaderStage::Compute, {}).error().message,
              "terrane/c.glsl: no such shader");
}

TEST(ShaderLoaderTest, filesUnderTheRootComeFirst) {
    const ScratchFolder folder;
    folder.write("terrane/b.h", "from disk\n");
    const ShaderLoader loader(kTwoFiles, folder.path());
    EXPECT_EQ(loader.find("terrane/b.h"), "from disk\n");
    EXPECT_EQ(loader.find("terrane/a.glsl"), kTwoFiles[0].data);
    EXPECT_EQ(loader.find("terrane"), std::nullopt);  // a folder
}

TEST(ShaderLoaderTest, laterFilesReplaceEarlierOnes) {
    constexpr std::array<base::EmbeddedFile, 1> kMore = {{{"terrane/b.h", "newer"}}};
    ShaderLoader loader(kTwoFiles);
    loader.addFiles(kMore);
    EXPECT_EQ(loader.find("terrane/b.h"), "newer");
}

TEST(ShaderLoaderTest, SeesWhenAShaderWasWritten) {
    const ScratchFolder folder;
    EXPECT_EQ(ShaderLoader(kTwoFiles).newestWrite(), std::nullopt) << "embedded files are never written";
    const ShaderLoader loader(kTwoFiles, folder.path());
    EXPECT_EQ(loader.newestWrite(), std::nullopt) << "there is no folder terrane";
    folder.write("terrane/readme.txt", "no shader");
    folder.write("other/a.glsl", "not included by a path that begins with terrane");
    EXPECT_EQ(loader.newestWrite(), std::nullopt);

    folder.write("terrane/b.h", "one");
    auto newest = loader.newestWrite();
    ASSERT_TRUE(newest);
    EXPECT_EQ(loader.newestWrite(), newest) << "nothing was written";
    for (const char* name : {"terrane/b.h", "terrane/deep/folder/c.comp.glsl"}) {
        folder.write(name, "two");
        std::filesystem::last_write_time(folder.path() / name, *newest + std::chrono::seconds(2));
        const auto before = std::exchange(newest, loader.newestWrite());
        EXPECT_EQ(newest, *before + std::chrono::seconds(2)) << name;
    }
    folder.write("terrane/readme.txt", "still no shader");
    std::filesystem::last_write_time(folder.path() / "terrane/readme.txt", *newest + std::chrono::seconds(9));
    EXPECT_EQ(loader.newestWrite(), newest);
}

}  // namespace
}  // namespace terrane::gpu
