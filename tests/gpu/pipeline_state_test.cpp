#include "terrane/gpu/pipeline_state.h"

#include "tests/gpu/gl_fixture.h"

namespace terrane::gpu {
namespace {

class PipelineStateTest : public GlTest {};

GLint integer(GLenum name) {
    GLint value = -1;
    glGetIntegerv(name, &value);
    return value;
}

bool isOn(GLenum capability) {
    return glIsEnabled(capability) == GL_TRUE;
}

const PipelineState kAllOn{.depthTest = DepthTest::Greater,
                           .writesDepth = false,
                           .clampsDepth = true,
                           .depthRange = {0.25f, 0.75f},
                           .blending = Blending::Over,
                           .cullsBackFaces = true};

void expectAllOn() {
    EXPECT_TRUE(isOn(GL_DEPTH_TEST) && isOn(GL_DEPTH_CLAMP) && isOn(GL_BLEND) && isOn(GL_CULL_FACE));
    EXPECT_EQ(integer(GL_DEPTH_FUNC), GL_GREATER);
    EXPECT_EQ(integer(GL_DEPTH_WRITEMASK), GL_FALSE);
    EXPECT_EQ(integer(GL_BLEND_SRC_RGB), GL_ONE);
    EXPECT_EQ(integer(GL_BLEND_DST_RGB), GL_ONE_MINUS_SRC_ALPHA);
    float range[2] = {};
    glGetFloatv(GL_DEPTH_RANGE, range);
    EXPECT_EQ(range[0], 0.25f);
    EXPECT_EQ(range[1], 0.75f);
}

TEST_F(PipelineStateTest, SetsAllThatADrawStates) {
    Pipeline pipeline;
    pipeline.set(kAllOn);
    expectAllOn();
    EXPECT_EQ(integer(GL_CLIP_DEPTH_MODE), GL_ZERO_TO_ONE);
    pipeline.set({});
    EXPECT_FALSE(isOn(GL_DEPTH_TEST) || isOn(GL_DEPTH_CLAMP) || isOn(GL_BLEND) || isOn(GL_CULL_FACE));
    EXPECT_EQ(integer(GL_DEPTH_WRITEMASK), GL_TRUE);
    pipeline.set(kAllOn);
    expectAllOn();
}

TEST_F(PipelineStateTest, ComparesDepthsAsStated) {
    Pipeline pipeline;
    const std::pair<DepthTest, GLint> tests[] = {{DepthTest::Always, GL_ALWAYS},
                                                 {DepthTest::Less, GL_LESS},
                                                 {DepthTest::Equal, GL_EQUAL},
                                                 {DepthTest::Greater, GL_GREATER}};
    for (const auto& [test, function] : tests) {
        pipeline.set({.depthTest = test});
        EXPECT_TRUE(isOn(GL_DEPTH_TEST));
        EXPECT_EQ(integer(GL_DEPTH_FUNC), function);
    }
}

TEST_F(PipelineStateTest, SetsOnlyWhatDiffersUntilItForgets) {
    Pipeline pipeline;
    pipeline.set(kAllOn);
    glDisable(GL_BLEND);
    PipelineState other = kAllOn;
    other.clampsDepth = false;
    pipeline.set(other);
    EXPECT_FALSE(isOn(GL_BLEND)) << "it was on before";
    EXPECT_FALSE(isOn(GL_DEPTH_CLAMP));
    pipeline.forget();
    pipeline.set(kAllOn);
    expectAllOn();
}

}  // namespace
}  // namespace terrane::gpu
