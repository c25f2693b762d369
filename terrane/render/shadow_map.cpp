#include "terrane/render/shadow_map.h"

#include "terrane/gpu/debug.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {
namespace {

// Depth along the light is linear: 16 bits over little more than twice kShadowReach at most are steps of a
// few thousandths of a block, in half the memory of more.
constexpr GLenum kFormat = GL_DEPTH_COMPONENT16;

}  // namespace

ShadowMap::ShadowMap(const gpu::ShaderLoader& shaders)
    : opaque_(quadShaders(shaders, "shadow", "opaque shadows")),
      tested_(quadShaders(shaders, "shadow", "tested shadows")),
      sampler_({.compare = GL_GEQUAL}, "shadow map") {}

base::Result<void> ShadowMap::configure(int size, bool hasFaceSampling) {
    if (size > 0) {
        auto selected =
            opaque_.select(defined({{"PASS", 2}, {"ALPHA_CLASS", 0}, {"FACE_SAMPLING", 0}, {"TINT", 0}}));
        if (selected)
            selected = tested_.select(
                defined({{"PASS", 2}, {"ALPHA_CLASS", 1}, {"FACE_SAMPLING", hasFaceSampling}, {"TINT", 0}}));
        if (!selected) return selected;
    }
    if (size == this->size()) return {};
    framebuffer_ = {};
    depth_ = {};
    if (size == 0) return {};
    gpu::Texture2D depth({size, size}, kFormat, 1, "shadow map");
    auto framebuffer = gpu::Framebuffer::create({{}, depth}, "shadow map");
    if (!framebuffer) return tl::unexpected(framebuffer.error());
    depth_ = std::move(depth);
    framebuffer_ = std::move(*framebuffer);
    return {};
}

// Depth grows toward the light. What stands nearer to it than the map begins casts too: its depth is clamped.
void ShadowMap::draw(gpu::Pipeline& pipeline, const QuadDraw& quads) const {
    const gpu::DebugGroup group("shadow map");
    constexpr gpu::PipelineState kNearestToLight{.depthTest = gpu::DepthTest::Greater, .clampsDepth = true};
    pipeline.set(kNearestToLight);
    framebuffer_.bind();
    framebuffer_.clearDepth(0.0f);
    quads.bind();
    opaque_.use();
    quads.draw(pipeline, kNearestToLight, {mesh::AlphaClass::Opaque, true});
    tested_.use();
    quads.draw(pipeline, kNearestToLight, {mesh::AlphaClass::Tested, true});
}

void ShadowMap::bind() const {
    depth_.bind(shared::kShadowUnit);
    sampler_.bind(shared::kShadowUnit);
}

}  // namespace terrane::render
