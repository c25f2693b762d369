#include "terrane/render/renderer.h"

#include <algorithm>
#include <cassert>
#include <glm/matrix.hpp>
#include <span>

#include "terrane/base/profile.h"
#include "terrane/gpu/debug.h"
#include "terrane/render/shadow_volume.h"
#include "terrane/shared/bindings.h"
#include "terrane/shared/frame.h"

namespace terrane::render {
namespace {

// A landscape at view distance 32: 1,500 regions with a record of 16 bytes and about three commands of 20.
constexpr std::size_t kRingBytes = 256u << 10;
// What slices may lose to alignment: the frame, the records and one list of commands a face context.
constexpr std::size_t kAlignmentSlack = 256 * (mesh::kContextCount + 2);
constexpr float kAmbientFromBelow = 0.4f;  // share of the sky's light on faces that look down
constexpr float kExposure = 0.92f;
constexpr int kLightViewDistance = 16;  // chunks, until setViewDistance
constexpr float kMaxAnisotropy = 8.0f;

// A corner and an edge's ends are each off by up to √½ steps of the rasteriser's grid: two quads that both
// grow by √½ steps meet. Corners of folded quads grow less, so more is taken; with 2 steps of 1/256 pixel one
// in a hundred samples along an edge changes.
constexpr float kCrackSteps = 2;

float crackGrowth() {
    GLint subpixelBits = 4;  // the least that OpenGL allows
    glGetIntegerv(GL_SUBPIXEL_BITS, &subpixelBits);
    return kCrackSteps / static_cast<float>(1 << subpixelBits);
}

shared::Frame frameOf(const FrameInput& input, const ViewMatrices& view, glm::vec2 size, float growth) {
    const world::Environment& e = input.environment;
    shared::Frame frame{};
    frame.viewProjection = view.viewProjection;
    frame.inverseViewProjection = glm::inverse(view.viewProjection);
    frame.cameraPosition = glm::vec4(view.cameraPosition, input.fogDistance);
    frame.lightDirection = glm::vec4(e.lightDirection, input.timeSeconds);
    frame.lightColor = glm::vec4(e.lightColor, e.discRadius);
    frame.ambientColor = glm::vec4(e.ambientColor, kAmbientFromBelow);
    frame.zenithColor = glm::vec4(e.zenithColor, kExposure);
    frame.horizonColor = glm::vec4(e.horizonColor, static_cast<float>(input.view));
    frame.glowColor = glm::vec4(e.glowColor, e.lampShare);
    frame.viewport = glm::vec4(size, input.coverCracks ? growth : 0.0f, 0.0f);
    return frame;
}

FrameStatistics statisticsOf(const DrawList& list) {
    FrameStatistics statistics{list.regionCount, list.quadCount};
    for (int context = 0; context < mesh::kContextCount; ++context) {
        const bool isBlended = mesh::contextAlphaClass(context) == mesh::AlphaClass::Blended;
        for (const DrawCommand& command : list.commands[static_cast<std::size_t>(context)]) {
            ++statistics.drawCommands;
            (isBlended ? statistics.transparentTriangles : statistics.opaqueTriangles) +=
                command.indexCount / 3;
        }
    }
    return statistics;
}

static_assert(static_cast<shared::uint>(View::Normal) == shared::kViewNormal &&
              static_cast<shared::uint>(View::Depth) == shared::kViewDepth &&
              static_cast<shared::uint>(View::Aggregation) == shared::kViewAggregation);

}  // namespace

base::Result<Renderer> Renderer::create(const gpu::ShaderLoader& shaders, const world::BlockRegistry& blocks,
                                        const TextureSource& textures, const gpu::DeviceInfo& device) {
    auto blockTextures = loadBlockTextures(blocks, textures);
    if (!blockTextures) return tl::unexpected(blockTextures.error());
    // A software renderer pays for each of the samples.
    const float anisotropy = device.software ? 1.0f : std::min(kMaxAnisotropy, device.maxAnisotropy);
    auto terrain = TerrainPass::create(shaders, blocks, std::move(*blockTextures), anisotropy);
    if (!terrain) return tl::unexpected(terrain.error());
    auto sky = FullscreenPass::create(shaders, "terrane/render/sky.frag.glsl", "sky");
    if (!sky) return tl::unexpected(sky.error());
    auto finalPass = FullscreenPass::create(shaders, "terrane/render/final.frag.glsl", "final");
    if (!finalPass) return tl::unexpected(finalPass.error());

    Renderer renderer;
    renderer.terrain_ = std::move(*terrain);
    renderer.sky_ = std::move(*sky);
    renderer.final_ = std::move(*finalPass);
    renderer.ring_ = gpu::MappedRing(kRingBytes, "frame data");
    renderer.light_ = LightStore(kLightViewDistance);
    renderer.maxSamples_ = device.maxSamples;
    renderer.maxSize_ = device.maxTextureSize;
    renderer.crackGrowth_ = crackGrowth();
    return renderer;
}

base::Result<void> Renderer::resize(glm::ivec2 size, int samples) {
    if (samples > maxSamples_) {
        return base::fail("{} samples a pixel: the graphics driver has at most {}", samples, maxSamples_);
    }
    if (size.x > maxSize_ || size.y > maxSize_) {
        return base::fail("{} × {} pixels: the graphics driver has at most {} a side", size.x, size.y,
                          maxSize_);
    }
    auto targets = makeTargets(size, samples);
    if (!targets) return tl::unexpected(targets.error());
    targets_ = std::move(*targets);
    return {};
}

base::Result<Renderer::Targets> Renderer::makeTargets(glm::ivec2 size, int samples) {
    assert(size.x > 0 && size.y > 0 && "a picture has pixels");
    Targets t;
    t.size = size;
    t.color = gpu::Texture2D(size, GL_RGBA16F, 1, "scene colour");
    t.pictureColor = gpu::Texture2D(size, GL_RGBA8, 1, "picture");
    gpu::FramebufferOptions sceneOptions{{t.color}, {}};
    // Not a multisampled texture of one sample: drivers may take the next number they have, Mesa's software
    // renderer four.
    if (samples == 1) {
        t.depth = gpu::Texture2D(size, GL_DEPTH_COMPONENT32F, 1, "depth");
        sceneOptions.depth = t.depth;
    } else if (auto added = addSamples(t, samples); !added) {
        return tl::unexpected(added.error());
    }
    auto scene = gpu::Framebuffer::create(sceneOptions, "scene");
    if (!scene) return tl::unexpected(scene.error());
    auto picture = gpu::Framebuffer::create({{t.pictureColor}, {}}, "picture");
    if (!picture) return tl::unexpected(picture.error());
    t.scene = std::move(*scene);
    t.picture = std::move(*picture);
    return t;
}

base::Result<void> Renderer::addSamples(Targets& t, int samples) {
    t.sampledColor = gpu::Texture2DMultisample(t.size, GL_RGBA16F, samples, "sampled colour");
    t.sampledDepth = gpu::Texture2DMultisample(t.size, GL_DEPTH_COMPONENT32F, samples, "sampled depth");
    auto sampled = gpu::Framebuffer::create({{t.sampledColor}, t.sampledDepth}, "sampled scene");
    if (!sampled) return tl::unexpected(sampled.error());
    t.sampled = std::move(*sampled);
    return {};
}

void Renderer::bindFrame(const FrameInput& input, const ViewMatrices& view) {
    shared::Frame frame = frameOf(input, view, glm::vec2(targets_.size), crackGrowth_);
    const world::ChunkPos chunk = cameraChunk(input.camera);
    const int mask = light_.gridChunks() - 1;
    frame.lightGrid = {2 * (chunk.x & mask), 2 * (chunk.y & mask), 2 * light_.gridChunks(), 0};
    const auto slice = ring_.write(std::span<const shared::Frame>(&frame, 1));
    assert(slice && "the ring is empty at the start of a frame");
    ring_.buffer().bindUniform(shared::kFrameBinding, slice->offsetBytes, sizeof(frame));
}

// A frame with more draws than the ring was made for gets a larger one; the GPU keeps the old one while it
// reads it.
void Renderer::reserveRing() {
    std::size_t bytes =
        sizeof(shared::Frame) + drawList_.records.size() * sizeof(shared::DrawRecord) + kAlignmentSlack;
    for (const auto& commands : drawList_.commands) bytes += commands.size() * sizeof(DrawCommand);
    if (bytes > ring_.regionBytes()) ring_ = gpu::MappedRing(2 * bytes, "frame data");
}

void Renderer::draw(const FrameInput& input) {
    TERRANE_ZONE("draw frame");
    assert(targets_.size.x > 0 && "resize comes before the first frame");
    const glm::vec2 size(targets_.size);
    const ViewMatrices view = viewMatrices(input.camera, size.x / size.y);
    buildDrawList(drawList_, quads_, input.camera, view);
    statistics_ = statisticsOf(drawList_);

    reserveRing();
    ring_.beginFrame();
    bindFrame(input, view);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    targets_.world().bind();
    targets_.world().clearDepth(0.0f);
    glDisable(GL_DEPTH_TEST);
    sky_.draw();
    light_.bind();
    terrain_.draw(drawList_, quads_, ring_, input.light);
    glDisable(GL_DEPTH_TEST);
    if (&targets_.world() != &targets_.scene) gpu::resolve(targets_.sampled, targets_.scene);
    targets_.picture.bind();
    targets_.color.bind(shared::kSceneColorUnit);
    final_.draw();
    ring_.endFrame();
}

std::size_t Renderer::shadowTriangles(const FrameInput& input) const {
    const glm::vec2 size(targets_.size);
    return countShadowTriangles(quads_, input.camera, viewMatrices(input.camera, size.x / size.y),
                                input.environment.lightDirection);
}

void Renderer::presentToWindow(glm::ivec2 windowSize) const {
    gpu::blitToWindow(targets_.picture, 0, windowSize, GL_NEAREST);
}

}  // namespace terrane::render
