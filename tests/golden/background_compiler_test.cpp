// Background compilation compiles shaders completely: later frames add nothing to the driver's cache.
#include "terrane/render/frame/background_compiler.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>
#include <utility>

#include "tests/base/temp_folder.h"
#include "tests/base/wait_until.h"
#include "tests/golden/effect_scenes.h"

namespace terrane::golden {
namespace {

using namespace std::chrono_literals;
using render::RenderOptions;

constexpr render::WorldFeatures kWorld{.hasTint = true, .hasLand = true};

class BackgroundCompilerTest : public GoldenTest {
  protected:
    // Set before there is a context. Mesa keeps a file per shader; Mesa 25 does so only if it is told to.
    static void SetUpTestSuite() {
        ::setenv("MESA_DISK_CACHE_MULTI_FILE", "true", 1);
        ::setenv("MESA_SHADER_CACHE_DIR", cache().path().c_str(), 1);
        ::setenv("MESA_SHADER_CACHE_DISABLE", "false", 1);
    }

    static base::TempFolder& cache() {
        static base::TempFolder folder;
        return folder;
    }

    // Waits until the driver's thread has written all files.
    static std::size_t filesInCache() {
        std::size_t count = 0;
        for (int stable = 0; stable < 3; ++stable) {
            std::this_thread::sleep_for(200ms);
            std::size_t now = 0;
            for (const auto& entry : std::filesystem::recursive_directory_iterator(cache().path()))
                now += entry.is_regular_file();
            if (std::exchange(count, now) != now) stable = -1;
        }
        return count;
    }

    static bool waitFor(render::BackgroundCompiler& compiler, const RenderOptions& options) {
        return base::waitUntil([&] { return compiler.isReady(kImageSize, options, kWorld); });
    }

    static void configure(render::Renderer& renderer, const RenderOptions& options) {
        const auto configured = renderer.configure(kImageSize, options);
        ASSERT_TRUE(configured) << (configured ? "" : configured.error().message);
    }

    render::BackgroundCompiler compiler_{render::contentShaders(), contentBlocks(), render::contentTexture};
};

TEST_F(BackgroundCompilerTest, FramesThatFollowCompileNextToNothing) {
    // Mesa treats a program that it compiled differently from one read from its cache. Read the renderer's
    // programs from the cache, as in all runs but the first.
    ASSERT_TRUE(waitFor(compiler_, render::plainOptions(kSamples)));
    render::Renderer& renderer = emptyRenderer();
    ASSERT_TRUE(renderer.useLand(kWorld.hasLand) && renderer.useTint(kWorld.hasTint));
    world::World world = flatWorld(2);
    placeGallery(world);
    placePool(world);
    for (const auto& [pos, mesh] : meshWorld(world)) renderer.setChunk(pos, mesh);
    renderer.setLight({0, 0}, light::ChunkLight());
    const render::FrameInput input{kAbove, world::environmentAt(0.34f), 400, 0, render::View::Color};
    draw(renderer, input);
    if (filesInCache() == 0) GTEST_SKIP() << "a driver without a cache of files";

    RenderOptions all = render::findPreset("thesis", true)->options;
    all.occlusion = render::Occlusion::On;
    RenderOptions others = render::findPreset("medium", true)->options;
    others.light = render::LightSampling::Smooth;
    others.tJunctions = render::TJunctions::Filled;
    others.shading = render::Shading::Pixel;
    std::size_t inBackground = 0, byRenderer = 0;
    for (const RenderOptions& options : {all, others}) {
        const std::size_t before = filesInCache();
        ASSERT_TRUE(waitFor(compiler_, options));
        const std::size_t compiled = filesInCache();
        configure(renderer, options);
        draw(renderer, input);
        draw(renderer, input);
        inBackground += compiled - before;
        byRenderer += filesInCache() - compiled;
    }
    EXPECT_GT(inBackground, 20u);
    // A few are compiled again: their state depends on earlier draws.
    EXPECT_LE(byRenderer, inBackground / 10);
}

TEST_F(BackgroundCompilerTest, TheLastWishIsMet) {
    RenderOptions options = render::findPreset("low", true)->options;
    for (const int layers : {0, 1, 2, 3}) {
        options.transparencyLayers = layers;
        EXPECT_FALSE(compiler_.isReady(kImageSize, options, kWorld));
    }
    ASSERT_TRUE(waitFor(compiler_, options));
    EXPECT_TRUE(compiler_.isReady({1280, 720}, options, kWorld)) << "programs do not depend on the size";
    RenderOptions same = options;
    same.shadowSize *= 2;
    same.animation = !same.animation;
    same.distanceFog = !same.distanceFog;
    EXPECT_TRUE(compiler_.isReady(kImageSize, same, kWorld)) << "nor on these options";
    options.transparencyLayers = 2;
    EXPECT_FALSE(compiler_.isReady(kImageSize, options, kWorld)) << "nobody waited for it";
}

// They may need other shaders.
TEST_F(BackgroundCompilerTest, AfterOtherTexturesAllIsCompiledAgain) {
    const RenderOptions options = render::findPreset("low", true)->options;
    ASSERT_TRUE(waitFor(compiler_, options));
    const auto asked = std::make_shared<std::atomic<int>>(0);
    compiler_.setTextures([asked](std::string_view name) {
        ++*asked;
        return render::contentTexture(name);
    });
    EXPECT_FALSE(compiler_.isReady(kImageSize, options, kWorld));
    ASSERT_TRUE(waitFor(compiler_, options));
    EXPECT_GT(*asked, 0) << "with the new textures";
}

}  // namespace
}  // namespace terrane::golden
