// Passes after a failure, and passes rebuilt from changed shaders.
#include "terrane/render/frame/frame.h"

#include <algorithm>
#include <set>

#include "terrane/base/files.h"
#include "terrane/render/frame/renderer.h"
#include "tests/golden/scenes.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/gpu/scratch_folder.h"
#include "tests/render/content.h"

namespace terrane::render {
namespace {

constexpr glm::ivec2 kPassesSize{96, 64};

constexpr std::string_view kFinalShader = "terrane/render/frame/final.frag.glsl";
constexpr std::string_view kRed =
    "layout(location = 0) out vec4 image;\nvoid main() { image = vec4(1, 0, 0, 1); }\n";
constexpr std::string_view kBroken = "this is no shader\n";

class FramePassesTest : public gpu::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped()) return;
        shaders_.emplace(embedded::shaders(), folder_.path());
        auto made = Renderer::create(*shaders_, contentBlocks(), contentTexture, gpu::queryDevice());
        ASSERT_TRUE(made) << made.error().message;
        renderer_ = std::move(*made);
        world::World world = golden::flatWorld(3);
        golden::placeGallery(world);
        golden::placePool(world);
        for (const auto& [pos, mesh] : golden::meshWorld(world)) renderer_->setChunk(pos, mesh);
    }
    void TearDown() override {
        renderer_.reset();
        GlTest::TearDown();
    }

    // Options of all passes with targets or state: shadows, layers, occlusion, blur, rays, culling.
    static RenderOptions fullOptions(int samples) {
        RenderOptions options;
        options.msaaSamples = samples;
        options.shadows = ShadowReach::Far;
        options.shadowSize = 256;
        options.occlusion = Occlusion::On;
        return options;
    }

    base::Image draw(const Camera& camera = {{-9, 5, 86}, 10, -14}) {
        FrameInput input{camera, world::environmentAt(0.4f), 120, 1, View::Color};
        const world::Figure figure{.eyes = camera.position + glm::dvec3(6, 0, -3)};
        input.figures = std::span(&figure, 1);
        renderer_->draw(input);
        return renderer_->readImage();
    }
    // The second image depends on the visibility found in the first one.
    base::Image drawTwice() {
        draw();
        return draw();
    }

    gpu::ScratchFolder folder_;
    std::optional<gpu::ShaderLoader> shaders_;
    std::optional<Renderer> renderer_;
};

// In whichever pass it fails, and in whichever direction the options change.
TEST_F(FramePassesTest, OptionsThatFailLeaveAllAsItWas) {
    struct Case {
        std::string name, condition;
    };
    const Case cases[] = {
        {"terrane/render/frame/final.frag.glsl", "RAW_OCCLUSION == 1"},
        {"terrane/render/cull/hi_z.comp.glsl", "MSAA_SAMPLES > 1"},
        {"terrane/render/effects/hole_fill.frag.glsl", "1"},
        {"terrane/render/shading/transparency.frag.glsl", "LAYERS == 1"},
    };
    RenderOptions other = fullOptions(4);
    other.shadowSize = 512;
    other.softShadows = true;
    other.shading = Shading::Pixel;
    other.transparencyLayers = 1;
    other.occlusion = Occlusion::Raw;
    other.tJunctions = TJunctions::Filled;
    other.clouds = other.sharpFiltering = other.depthOfField = other.godRays = false;
    for (const Case& c : cases) {
        const std::string original = *contentShaders().find(c.name);
        const RenderOptions options = fullOptions(1);
        ASSERT_TRUE(renderer_->configure(kPassesSize, options));
        folder_.write(c.name, fmt::format("#if {}\n{}#endif\n{}", c.condition, kBroken, original));
        ASSERT_TRUE(renderer_->reloadShaders());
        const base::Image before = drawTwice();
        for (const glm::ivec2 size : {2 * kPassesSize, kPassesSize}) {
            const auto configured = renderer_->configure(size, other);
            ASSERT_FALSE(configured) << c.name;
            EXPECT_NE(configured.error().message.find(c.name), std::string::npos)
                << configured.error().message;
            EXPECT_EQ(renderer_->size(), kPassesSize);
            EXPECT_EQ(renderer_->options(), options);
            EXPECT_EQ(draw().rgba, before.rgba) << c.name;
            EXPECT_EQ(draw().rgba, before.rgba) << c.name;
        }
        folder_.write(c.name, original);
        ASSERT_TRUE(renderer_->configure(2 * kPassesSize, other)) << "what failed is not remembered";
        draw();
    }
}

TEST_F(FramePassesTest, ShadersThatStayGiveTheSameImageAtOnce) {
    for (const int samples : {1, 4}) {
        ASSERT_TRUE(renderer_->configure(kPassesSize, fullOptions(samples)));
        const base::Image before = drawTwice();
        ASSERT_TRUE(renderer_->reloadShaders());
        EXPECT_EQ(draw().rgba, before.rgba) << "the first frame, " << samples << " samples";
        EXPECT_EQ(draw().rgba, before.rgba);
    }
}

TEST_F(FramePassesTest, WrittenShadersAreSeenAndWrongOnesChangeNothing) {
    ASSERT_TRUE(renderer_->configure(kPassesSize, fullOptions(1)));
    const base::Image before = drawTwice();
    folder_.write(kFinalShader, kRed);
    EXPECT_EQ(draw().rgba, before.rgba) << "not before they are read";
    ASSERT_TRUE(renderer_->reloadShaders());
    const base::Image red = draw();
    for (std::size_t k = 0; k < red.rgba.size(); k += 4) {
        ASSERT_EQ(red.rgba[k], 255);
        ASSERT_EQ(red.rgba[k + 1], 0);
    }

    folder_.write(kFinalShader, kBroken);
    const auto reloaded = renderer_->reloadShaders();
    ASSERT_FALSE(reloaded);
    EXPECT_EQ(reloaded.error().message.find(kFinalShader), 0u) << reloaded.error().message;
    EXPECT_EQ(draw().rgba, red.rgba);
    folder_.write("terrane/render/cull/cull.comp.glsl", kBroken);  // a pass that is made before all others
    ASSERT_FALSE(renderer_->reloadShaders());
    EXPECT_EQ(draw().rgba, red.rgba);

    std::filesystem::remove_all(folder_.path() / "terrane");
    ASSERT_TRUE(renderer_->reloadShaders());
    EXPECT_EQ(draw().rgba, before.rgba) << "what is compiled in is back";
}

TEST_F(FramePassesTest, ShadersCanBeWrittenBeforeThereIsAnImage) {
    folder_.write(kFinalShader, kRed);
    ASSERT_TRUE(renderer_->reloadShaders());
    ASSERT_TRUE(renderer_->configure(kPassesSize, fullOptions(1)));
    EXPECT_EQ(draw().rgba[0], 255);
}

// Code that writes times into columns needs the names of all passes.
TEST_F(FramePassesTest, EachPassThatIsOnIsMeasured) {
    RenderOptions options = fullOptions(1);
    options.tJunctions = TJunctions::Filled;
    options.renderScale = 50;
    ASSERT_TRUE(renderer_->configure(kPassesSize, options));
    for (int frame = 0; frame < 4; ++frame) {
        draw({{-9, 5, 340}, 10, -50});  // clouds are drawn for a camera near or above them
        glFinish();
    }
    std::vector<std::string_view> expected = passNames();
    ASSERT_EQ(std::erase(expected, "debug view"), 1u);
    std::vector<std::string_view> measured;
    for (const gpu::GpuTiming& pass : renderer_->passTimes()) measured.push_back(pass.name);
    EXPECT_EQ(measured, expected) << "all options are on";
}

// What a pass reads, a pass before it has written.
TEST_F(FramePassesTest, PassesReadWhatIsWritten) {
    for (const Preset& preset : presets()) {
        ASSERT_TRUE(renderer_->configure(kPassesSize, preset.options));
        std::set<const Target*> written;
        for (const Pass& pass : renderer_->frame().passes) {
            for (const TargetRef& target : pass.reads)
                EXPECT_TRUE(written.contains(target.get()))
                    << pass.name << " reads " << target->shape().label;
            for (const TargetRef& target : pass.writes) written.insert(target.get());
        }
    }
}

// docs/rendering.md lists the passes.
TEST_F(FramePassesTest, AreThoseOfTheDocument) {
    ASSERT_TRUE(renderer_->configure(kPassesSize, findPreset("high", false)->options));
    const auto page = base::readFile(std::filesystem::path(TERRANE_SOURCE_DIR) / "docs/rendering.md");
    ASSERT_TRUE(page) << page.error().message;
    const std::string passes = textOf(renderer_->frame());
    EXPECT_NE(page->find("```text\n" + passes + "```"), std::string::npos) << passes;
}

// Options that stay the same keep their targets, and what an option needed is freed.
TEST_F(FramePassesTest, TargetsAreKeptAndFreed) {
    RenderOptions options = fullOptions(1);
    ASSERT_TRUE(renderer_->configure(kPassesSize, options));
    const Frame before = renderer_->frame();
    options.godRays = false;
    ASSERT_TRUE(renderer_->configure(kPassesSize, options));
    EXPECT_EQ(renderer_->frame().targets.scene, before.targets.scene);
    EXPECT_EQ(renderer_->frame().shadowMap, before.shadowMap);
    constexpr glm::ivec2 kThird = (kPassesSize + 2) / 3;
    EXPECT_EQ(before.targetBytes() - renderer_->frame().targetBytes(), std::size_t{2} * kThird.x * kThird.y);
}

}  // namespace
}  // namespace terrane::render
