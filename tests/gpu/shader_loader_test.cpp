#include "terrane/gpu/shader_loader.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>

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

TEST(ShaderLoaderTest, seesWhenAFileWasWritten) {
    const ScratchFolder folder;
    folder.write("terrane/b.h", "one");
    const ShaderLoader loader(kTwoFiles, folder.path());
    const std::vector<std::string> files = {"terrane/a.glsl", "terrane/b.h"};
    const auto before = loader.newestWrite(files);
    EXPECT_EQ(loader.newestWrite(files), before);
    folder.setNewer("terrane/b.h");
    EXPECT_GT(loader.newestWrite(files), before);
    EXPECT_EQ(ShaderLoader(kTwoFiles).newestWrite(files), std::filesystem::file_time_type::min());
}

}  // namespace
}  // namespace terrane::gpu
