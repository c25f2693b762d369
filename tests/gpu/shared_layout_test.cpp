// Structs of terrane/shared have the layout in std430 that C++ gives them, as the driver itself reports it.

#include <cstddef>
#include <string>

#include "terrane/gpu/program.h"
#include "terrane/shared/quad.h"
#include "tests/gpu/gl_fixture.h"

namespace terrane::gpu {
namespace {

class SharedLayoutTest : public GlTest {};

struct VariableLayout {
    GLint offset = -1;
    GLint topStride = -1;
};

VariableLayout layoutOf(GLuint program, const char* name) {
    const GLuint index = glGetProgramResourceIndex(program, GL_BUFFER_VARIABLE, name);
    if (index == GL_INVALID_INDEX) return {};
    const GLenum properties[] = {GL_OFFSET, GL_TOP_LEVEL_ARRAY_STRIDE};
    GLint values[2] = {-1, -1};
    glGetProgramResourceiv(program, GL_BUFFER_VARIABLE, index, 2, properties, 2, nullptr, values);
    return {values[0], values[1]};
}

TEST_F(SharedLayoutTest, quad) {
    constexpr std::string_view kText = R"(
#include "terrane/shared/constants.h"
#include "terrane/shared/hash.h"
#include "terrane/shared/quad.h"
layout(local_size_x = kChunkSize) in;
layout(binding = 0, std430) buffer Quads { Quad quads[]; };
void main() {
    Quad q = quads[gl_LocalInvocationIndex];
    quads[gl_LocalInvocationIndex].word0 = quadX(q) + quadY(q) + quadZ(q) + quadShapeFace(q);
    quads[gl_LocalInvocationIndex].word1 = hash3(quadExtentU(q), quadExtentV(q), quadMaterial(q), q.word1);
}
)";
    const base::EmbeddedFile file = {"quad.comp.glsl", kText};
    const ShaderLoader loader(std::span(&file, 1), TERRANE_SOURCE_DIR);
    const base::Result<Program> program = Program::compute(loader, file.path, {}, "quad layout");
    ASSERT_TRUE(program) << program.error().message;
    const VariableLayout word0 = layoutOf(program->id(), "quads[0].word0");
    const VariableLayout word1 = layoutOf(program->id(), "quads[0].word1");
    EXPECT_EQ(word0.offset, static_cast<GLint>(offsetof(shared::Quad, word0)));
    EXPECT_EQ(word1.offset, static_cast<GLint>(offsetof(shared::Quad, word1)));
    EXPECT_EQ(word0.topStride, static_cast<GLint>(sizeof(shared::Quad)));
}

}  // namespace
}  // namespace terrane::gpu
