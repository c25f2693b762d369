// Rays in shaders and on the CPU: the same cells, faces and bits of t.

#include "terrane/shared/ray_cast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "terrane/gpu/buffer.h"
#include "terrane/gpu/program.h"
#include "terrane/rays/cast.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/rays/ray_world.h"
#include "tests/support/depth.h"

namespace terrane::gpu {
namespace {

class RayCastTest : public GlTest {};

// Casts each ray; then another one from where it ends, back and to the side.
constexpr std::string_view kShader = R"(
#include "terrane/shared/ray_step.h"
layout(local_size_x = 64) in;
layout(binding = 0, std430) readonly buffer Words { uint rayWords[]; };
layout(binding = 1, std430) readonly buffer Rays { Ray rays[]; };
layout(binding = 2, std430) writeonly buffer Hits { RayHit hits[]; };
#include "terrane/shared/ray_cast.h"
void main() {
    uint k = gl_GlobalInvocationID.x;
    if (k >= uint(rays.length())) return;
    Ray ray = rays[k];
    RayHit hit = castRay(0u, ray);
    hits[2u * k] = hit;
    if (hit.face >= kRayFaceNone) return;
    hits[2u * k + 1u] = castRay(0u, rayFromFace(ray, hit, secondDirection(k, hit.face), 1e9f));
}
)";

// In both languages.
constexpr const char* kSecondDirection = R"(
vec4 secondDirection(uint k, uint face) {
    vec4 direction = vec4(float(k % 7u) - 3.0f, float(k % 11u) - 5.0f, float(k % 5u) - 2.0f, 0.0f);
    direction[int(face >> 1)] = (face & 1u) == 0u ? -1.5f : 1.5f;
    return direction;
}
)";
glm::vec4 secondDirection(unsigned k, unsigned face) {
    glm::vec4 direction(static_cast<float>(k % 7) - 3, static_cast<float>(k % 11) - 5,
                        static_cast<float>(k % 5) - 2, 0);
    direction[static_cast<int>(face >> 1)] = (face & 1) == 0 ? -1.5f : 1.5f;
    return direction;
}

TEST_F(RayCastTest, ShadersFindTheSameHits) {
    std::string text(kShader);
    text.insert(text.find("void main"), kSecondDirection);
    const base::EmbeddedFile file = {"rays.comp.glsl", text};
    const ShaderLoader loader(std::span(&file, 1), TERRANE_SOURCE_DIR);
    const base::Result<Program> program = Program::compute(loader, file.path, {}, "rays");
    ASSERT_TRUE(program) << program.error().message;

    std::mt19937 random(7);
    const int worlds = 5;
    const std::size_t count = static_cast<std::size_t>(atDepth(1'000'000, 10'000'000) / worlds);
    std::size_t wrong = 0, seconds = 0;
    for (int k = 0; k < worlds; ++k) {
        const rays::RayWorld made = rays::randomWorld(random, 1 + k % 4);
        const rays::Scene scene = made.scene();
        std::vector<shared::Ray> first;
        for (std::size_t n = 0; n < count; ++n) first.push_back(rays::randomRay(made, random));
        const Buffer words(std::as_bytes(std::span(scene.words)), 0, "words");
        const Buffer rayBuffer(std::as_bytes(std::span(first)), 0, "rays");
        const Buffer hitBuffer(2 * count * sizeof(shared::RayHit), 0, "hits");
        words.bindStorage(0);
        rayBuffer.bindStorage(1);
        hitBuffer.bindStorage(2);
        program->use();
        glDispatchCompute(static_cast<GLuint>((count + 63) / 64), 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        std::vector<shared::RayHit> onGpu(2 * count);
        hitBuffer.download(0, std::as_writable_bytes(std::span(onGpu)));

        std::vector<shared::RayHit> onCpu(count);
        rays::castRays(rays::raysThrough(scene), first, onCpu);
        for (std::size_t n = 0; n < count; ++n) {
            wrong += !rays::isSame(onCpu[n], onGpu[2 * n]);
            if (onCpu[n].face >= shared::kRayFaceNone) continue;
            const glm::vec4 direction = secondDirection(static_cast<unsigned>(n), onCpu[n].face);
            const shared::Ray second = shared::rayFromFace(first[n], onCpu[n], direction, 1e9f);
            wrong += !rays::isSame(shared::castRay(rays::raysThrough(scene), second), onGpu[2 * n + 1]);
            ++seconds;
        }
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(seconds, worlds * count / 4);
}

}  // namespace
}  // namespace terrane::gpu
