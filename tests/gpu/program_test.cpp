#include "terrane/gpu/program.h"

#include <array>
#include <type_traits>

#include "terrane/gpu/buffer.h"
#include "terrane/gpu/framebuffer.h"
#include "terrane/gpu/vertex_array.h"
#include "tests/gpu/gl_fixture.h"

namespace terrane::gpu {
namespace {

static_assert(!std::is_copy_constructible_v<Program> && std::is_nothrow_move_assignable_v<Program>);
static_assert(!std::is_copy_constructible_v<VertexArray> && std::is_nothrow_move_assignable_v<VertexArray>);

class ProgramTest : public GlTest {};

constexpr std::string_view kCompute = R"(
layout(local_size_x = 1) in;
layout(binding = 0, std430) buffer Out { uint result; };
layout(location = 0) uniform uint addend;
void main() { result = VALUE + addend; }
)";
constexpr std::string_view kVertex = R"(
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }
)";
constexpr std::string_view kFragment = R"(
layout(location = 0) out vec4 color;
layout(location = 3) uniform uvec4 tint;
void main() { color = vec4(tint) / 255.0; }
)";
constexpr std::array<base::EmbeddedFile, 7> kFiles = {{
    {"sum.comp.glsl", kCompute},
    {"full.vert.glsl", kVertex},
    {"tint.frag.glsl", kFragment},
    {"outer.comp.glsl", "layout(local_size_x = 1) in;\n#include \"inner.h\"\nvoid main() {}\n"},
    {"inner.h", "\n\nint f() { return undeclaredName; }\n"},
    {"unlinked.comp.glsl", "layout(local_size_x = 1) in;\nvoid missing();\nvoid main() { missing(); }\n"},
    {"missing.comp.glsl", "#include \"nowhere.h\"\n"},
}};

GLuint runCompute(const Program& program, const Buffer& out) {
    program.use();
    out.bindStorage(0);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    GLuint result = 0;
    out.download(0, std::as_writable_bytes(std::span(&result, 1)));
    return result;
}

TEST_F(ProgramTest, definesMakeVariants) {
    const ShaderLoader loader(kFiles);
    const Buffer out(4, 0, "out");
    for (const GLuint value : {7U, 11U}) {
        const ShaderDefines defines = {{"VALUE", std::to_string(value) + "u"}};
        const base::Result<Program> program = Program::compute(loader, "sum.comp.glsl", defines, "sum");
        ASSERT_TRUE(program) << program.error().message;
        EXPECT_EQ(runCompute(*program, out), value);
        program->set(0, 30U);
        EXPECT_EQ(runCompute(*program, out), value + 30);
    }
}

TEST_F(ProgramTest, drawsWithoutVertexAttributes) {
    const ShaderLoader loader(kFiles);
    const base::Result<Program> program =
        Program::graphics(loader, "full.vert.glsl", "tint.frag.glsl", {}, "tint");
    ASSERT_TRUE(program) << program.error().message;
    const Texture2D color({4, 4}, GL_RGBA8, 1, "color");
    const base::Result<Framebuffer> target = Framebuffer::create({.colors = {color}, .depth = {}}, "target");
    ASSERT_TRUE(target) << target.error().message;
    const std::array<GLuint, 3> indices = {0, 1, 2};
    const Buffer elements(std::as_bytes(std::span(indices)), 0, "indices");
    VertexArray vertices("vertices");
    vertices.setElementBuffer(elements);
    target->bind();
    program->use();
    program->set(3, glm::uvec4(0, 255, 0, 255));
    vertices.bind();
    glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_INT, nullptr);
    const base::Image image = readPixels(*target);
    EXPECT_EQ(image.rgba[0], 0);
    EXPECT_EQ(image.rgba[1], 255);
    const VertexArray moved = std::move(vertices);
    EXPECT_EQ(vertices.id(), 0U);
    EXPECT_NE(moved.id(), 0U);
}

TEST_F(ProgramTest, compileErrorsNameTheFileAndLine) {
    const ShaderLoader loader(kFiles);
    const base::Result<Program> program = Program::compute(loader, "outer.comp.glsl", {}, "outer");
    ASSERT_FALSE(program);
    const std::string& message = program.error().message;
    EXPECT_TRUE(message.starts_with("outer.comp.glsl: the shader does not compile: ")) << message;
    const bool named = message.find("inner.h:3") != std::string::npos ||  // Mesa
                       message.find("inner.h(3)") != std::string::npos;   // NVIDIA
    EXPECT_TRUE(named) << message;
    EXPECT_NE(message.find("undeclaredName"), std::string::npos) << message;
}

TEST_F(ProgramTest, otherErrorsNameTheProgramOrFile) {
    const ShaderLoader loader(kFiles);
    const base::Result<Program> unlinked = Program::compute(loader, "unlinked.comp.glsl", {}, "unlinked");
    ASSERT_FALSE(unlinked);
    EXPECT_TRUE(unlinked.error().message.starts_with("unlinked")) << unlinked.error().message;
    const base::Result<Program> missing = Program::compute(loader, "missing.comp.glsl", {}, "missing");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().message, "missing.comp.glsl:1: #include: no file nowhere.h");
}

TEST_F(ProgramTest, movesAndLeavesAnEmptyOne) {
    const ShaderLoader loader(kFiles);
    base::Result<Program> made = Program::compute(loader, "sum.comp.glsl", {{"VALUE", "5u"}}, "sum");
    ASSERT_TRUE(made) << made.error().message;
    Program first = *std::move(made);
    EXPECT_EQ(made->id(), 0U);
    Program second;
    second = std::move(first);
    EXPECT_EQ(first.id(), 0U);
    EXPECT_EQ(runCompute(second, Buffer(4, 0, "out")), 5U);
}

}  // namespace
}  // namespace terrane::gpu
