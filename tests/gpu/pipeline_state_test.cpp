#include "terrane/gpu/pipeline_state.h"

#include <array>

#include "terrane/gpu/buffer.h"
#include "terrane/gpu/framebuffer.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/vertex_array.h"
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
                           .cullsBackFaces = true,
                           .readsSampleId = true};

void expectAllOn() {
    EXPECT_TRUE(isOn(GL_DEPTH_TEST) && isOn(GL_DEPTH_CLAMP) && isOn(GL_BLEND) && isOn(GL_CULL_FACE));
    EXPECT_TRUE(isOn(GL_SAMPLE_MASK));
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
    EXPECT_FALSE(isOn(GL_SAMPLE_MASK));
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
    pipeline.invalidate();
    pipeline.set(kAllOn);
    expectAllOn();
}

constexpr std::string_view kScreenVertex = R"(
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }
)";
constexpr std::string_view kPlainFragment = R"(
layout(location = 0) out vec4 color;
void main() { color = vec4(0.5); }
)";
constexpr std::string_view kSampleFragment = R"(
layout(location = 0) out vec4 color;
layout(binding = 0, std430) buffer Out { uint samplesSeen; };
void main() {
    atomicOr(samplesSeen, 1u << gl_SampleID);
    color = vec4(gl_SampleID);
}
)";
constexpr std::array<base::EmbeddedFile, 3> kSampleShaders = {{{"screen.vert.glsl", kScreenVertex},
                                                               {"plain.frag.glsl", kPlainFragment},
                                                               {"sample.frag.glsl", kSampleFragment}}};

// Also after a draw into the same framebuffer that ran once a pixel.
TEST_F(PipelineStateTest, RunsForEachSampleWhereAShaderReadsItsNumber) {
    const ShaderLoader loader(kSampleShaders);
    const auto plain = Program::graphics(loader, "screen.vert.glsl", "plain.frag.glsl", {}, "plain");
    const auto sampled = Program::graphics(loader, "screen.vert.glsl", "sample.frag.glsl", {}, "sampled");
    ASSERT_TRUE(plain && sampled);
    const Texture2DMultisample color({4, 4}, GL_RGBA8, 4, "color");
    const auto target = Framebuffer::create({.colors = {color}, .depth = {}}, "target");
    ASSERT_TRUE(target) << target.error().message;
    const GLuint none = 0;
    const Buffer out(std::as_bytes(std::span(&none, 1)), 0, "samples seen");
    const VertexArray vertices("vertices");
    target->bind();
    vertices.bind();
    out.bindStorage(0);
    Pipeline pipeline;
    pipeline.set({});
    plain->use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    pipeline.set({.readsSampleId = true});
    sampled->use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    GLuint seen = 0;
    out.download(0, std::as_writable_bytes(std::span(&seen, 1)));
    EXPECT_EQ(seen, (1u << target->samples()) - 1);
}

}  // namespace
}  // namespace terrane::gpu
