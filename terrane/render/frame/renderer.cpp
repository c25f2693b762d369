#include "terrane/render/frame/renderer.h"

#include <algorithm>
#include <span>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/gpu/program.h"
#include "terrane/render/figures/figure_pass.h"
#include "terrane/render/frame/edge_expansion.h"
#include "terrane/render/frame/frame_statistics.h"
#include "terrane/render/frame/frame_targets.h"
#include "terrane/render/frame/frame_uniforms.h"
#include "terrane/render/shadow/shadow_volume.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

namespace {

// Uniforms of a frame (camera, tint, air, land, shadows), those of culling twice, and those of the shadow map
// rectangles that figures are drawn into, aligned; then the figures in view, and those that cast shadows.
constexpr std::size_t kRingBytes = 8192 + ShadowMap::kFigureRingBytes + 2 * FigurePass::kRingBytes;
constexpr int kLightViewDistance = 16;  // chunks, until setViewDistance
constexpr float kMaxAnisotropy = 8.0f;

// Least light that casts shadows, linear: between sun and moon the light is too dark to see.
constexpr float kMinShadowedLight = 0.002f;

float aspectOf(glm::ivec2 size) {
    return static_cast<float>(size.x) / static_cast<float>(size.y);
}

}  // namespace

base::Result<Renderer> Renderer::create(const gpu::ShaderLoader& shaders, const world::BlockRegistry& blocks,
                                        const TextureSource& textures, const gpu::DeviceInfo& device,
                                        const QuadStoreSizes& quads, int maxTextureSide) {
    const TextureLimits limits{device.maxArrayLayers, maxTextureSide};
    auto blockTextures = TERRANE_TRY(loadBlockTextures(blocks, textures, limits));
    auto topColors = TERRANE_TRY(world::topColors(blocks, textures));
    auto passes = TERRANE_TRY(FramePasses::create(shaders, device));

    Renderer renderer;
    renderer.topColors_ = std::move(topColors);
    // Software renderers take time for each sample.
    const float anisotropy = device.software ? 1.0f : std::min(kMaxAnisotropy, device.maxAnisotropy);
    renderer.resources_ = QuadResources(blocks, std::move(blockTextures), anisotropy);
    renderer.passes_ = std::move(passes);
    renderer.noise_ = SkyNoise::create();
    renderer.sky_ = SkyTexture::create();
    renderer.ring_ = gpu::MappedRing(kRingBytes, "frame data");
    if (!renderer.ring_.isMapped())
        return base::fail(base::ErrorCode::OutOfResources,
                          "the graphics driver has no memory for frame data");
    renderer.viewDistance_ = kLightViewDistance;
    renderer.quadSizes_ = quads;
    renderer.clearChunks();
    renderer.shaders_ = &shaders;
    renderer.device_ = device;
    renderer.textureLimits_ = limits;
    return renderer;
}

base::Result<void> Renderer::setTextures(const world::BlockRegistry& blocks, const TextureSource& textures) {
    auto loaded = TERRANE_TRY(loadBlockTextures(blocks, textures, textureLimits_));
    auto colors = TERRANE_TRY(world::topColors(blocks, textures));
    if (targets_.size.x > 0) {
        TERRANE_TRY(configurePasses(targets_, options_,
                                    {needsFaceSampling(blocks, loaded), tints_.isUsed(), land_.isUsed()}));
    }
    topColors_ = std::move(colors);
    if (land_.isUsed()) land_ = LandTextures::create(topColors_);  // its tiles come again, with these colors
    resources_.setTextures(blocks, std::move(loaded));
    passes_.shadowMap.forget();
    return {};
}

// If it fails, the passes are as before.
base::Result<void> Renderer::configurePasses(const FrameTargets& targets, const RenderOptions& options,
                                             const QuadFeatures& features) {
    auto done = passes_.configure(targets, options, features);
    if (done || targets_.size.x == 0) return done;
    const auto undone = passes_.configure(targets_, options_, this->features());
    if (!undone) base::logError("the previous options cannot be restored: {}", undone.error().message);
    return done;
}

base::Result<void> Renderer::configure(glm::ivec2 size, const RenderOptions& options) {
    if (options.msaaSamples > device_.maxSamples) {
        return base::fail("{} samples per pixel: the graphics driver has at most {}", options.msaaSamples,
                          device_.maxSamples);
    }
    if (std::min(size.x, size.y) < 1) {
        return base::fail(base::ErrorCode::BadInput, "{} × {} pixels: an image has at least 1 per side",
                          size.x, size.y);
    }
    if (std::max(size.x, size.y) > device_.maxTextureSize) {
        return base::fail("{} × {} pixels: the graphics driver has at most {} per side", size.x, size.y,
                          device_.maxTextureSize);
    }
    std::optional<FrameTargets> made;
    if (size != targets_.size || options.msaaSamples != targets_.requestedMsaaSamples) {
        auto targets = TERRANE_TRY(FrameTargets::create(size, options.msaaSamples));
        made = std::move(targets);
    }
    TERRANE_TRY(configurePasses(made ? *made : targets_, options, features()));
    if (made) targets_ = std::move(*made);
    options_ = options;
    return {};
}

base::Result<void> Renderer::reloadShaders() {
    auto passes = TERRANE_TRY(FramePasses::create(*shaders_, device_));
    if (targets_.size.x > 0) {
        TERRANE_TRY(passes.configure(targets_, options_, features()));
    }
    passes_ = std::move(passes);
    return {};
}

base::Result<void> Renderer::useTint(bool isUsed) {
    if (targets_.size.x > 0 && isUsed != tints_.isUsed()) {
        TERRANE_TRY(
            configurePasses(targets_, options_, {resources_.hasFaceSampling(), isUsed, land_.isUsed()}));
    }
    tints_ = isUsed ? TintTextures::create() : TintTextures();
    return {};
}

base::Result<void> Renderer::useLand(bool isUsed) {
    if (targets_.size.x > 0 && isUsed != land_.isUsed()) {
        TERRANE_TRY(
            configurePasses(targets_, options_, {resources_.hasFaceSampling(), tints_.isUsed(), isUsed}));
    }
    land_ = isUsed ? LandTextures::create(topColors_) : LandTextures();
    return {};
}

bool Renderer::hasShadows(const FrameInput& input) const {
    const glm::vec3 light = input.environment.lightColor;
    const bool isLit = std::max({light.x, light.y, light.z}) > kMinShadowedLight;
    return passes_.shadowMap.isOn() && input.view == View::Color && isLit;
}

void Renderer::bindFrame(const FrameInput& input, const ViewMatrices& view) {
    shared::Frame frame =
        frameUniforms(input, options_,
                      {view, glm::vec2(targets_.size), edgeExpansion(device_.subpixelBits, targets_.size)});
    const world::ChunkPos chunk = cameraChunk(input.camera);
    const int mask = light_.gridChunks() - 1;
    constexpr int kTilesOfChunk = static_cast<int>(shared::kChunkSize / shared::kLightTileSize);
    frame.firstLightTile = {kTilesOfChunk * (chunk.x & mask), kTilesOfChunk * (chunk.y & mask)};
    frame.lightGridTiles = kTilesOfChunk * light_.gridChunks();
    ring_.writeUniform(shared::kFrameBinding, frame);
    tints_.bind(input.camera, ring_);
    sky_.bind(input.environment, view.cameraPosition.z, ring_);
    const int levels = std::exchange(completesLand_, false) ? LandTextures::kAllLevels : 1;
    if (!readsLand()) return;
    land_.update(input.camera, {input.environment.lightDirection, input.environment.discRadius}, levels);
    land_.bind(input.camera, ring_);
}

CullInput Renderer::cullInput(const FrameInput& input, const ViewMatrices& view) const {
    CullInput cull{cameraChunk(input.camera), view.cameraPosition, frustumOf(view.viewProjection),
                   view.viewProjection, glm::vec2(targets_.size)};
    cull.quads = &quads_;
    cull.resources = &resources_;
    cull.edgeExpansion = edgeExpansion(device_.subpixelBits, targets_.size);
    cull.blockPixels = 0.5f * cull.size.y / glm::length(view.up);
    cull.samples = targets_.msaaSamples;
    if (input.culledFor) {
        cull.camera = frustumOf(viewMatrices(*input.culledFor, aspectOf(targets_.size)).viewProjection);
    }
    return cull;
}

void Renderer::cull(CullPhase phase, const CullInput& input) {
    const TimerZone zone(timer_, phase == CullPhase::Late ? "cull again" : "cull");
    passes_.cull.run(phase, input, meshSections_, ring_);
}

QuadDraw Renderer::quadDraw() {
    return {resources_, quads_, meshSections_, passes_.cull, options_.sharpFiltering};
}

ShadingInputs Renderer::shadingInputs(const FrameInput& input) const {
    return {light_, passes_.shadowMap, noise_, input.waterAbove > 0};
}

void Renderer::drawShadows(const FrameInput& input) {
    passes_.shadowMap.markChanged(meshSections_.takeChanges());
    if (hasShadows(input)) {
        const TimerZone zone(timer_, "shadow map");
        passes_.shadowMap.update(pipeline_, {resources_, quads_, meshSections_}, input.camera,
                                 input.environment.lightDirection, input.maxShadowTiles);
        const auto figures = figureRecords(input.figures, input.camera, {}, kFigureShadowReach);
        passes_.shadowMap.drawFigures(pipeline_, passes_.figures, {figures, cameraChunk(input.camera)},
                                      ring_);
    }
    passes_.shadowMap.bindUniforms(input.camera, hasShadows(input), ring_);
}

void Renderer::drawSurfaces() {
    const TimerZone zone(timer_, "surfaces");
    passes_.gbuffer.clear(pipeline_, targets_);
    passes_.gbuffer.draw(pipeline_, targets_, quadDraw());
}

// Draws surfaces that were hidden in the frame before and are visible now.
void Renderer::drawLate(const CullInput& cullInput) {
    {
        const TimerZone zone(timer_, "depth pyramid");
        passes_.hiZ.build(targets_);
    }
    cull(CullPhase::Late, cullInput);
    const TimerZone zone(timer_, "surfaces again");
    passes_.gbuffer.draw(pipeline_, targets_, quadDraw());
}

// Comes after holes are filled, which would take thin distant arms for holes.
void Renderer::drawFigures(const FrameInput& input, const CullInput& cullInput) {
    if (input.figures.empty()) return;
    const auto records =
        figureRecords(input.figures, input.camera, cullInput.camera, double{input.fogDistance});
    if (records.empty()) return;
    const TimerZone zone(timer_, "figures");
    passes_.figures.bind(records, ring_);
    passes_.figures.draw(pipeline_, targets_, records.size());
}

void Renderer::shadeSurfaces(const FrameInput& input) {
    {
        const TimerZone zone(timer_, "sky");
        const bool isNight = input.environment.starLight > 0 || input.environment.isMoon;
        passes_.shading.drawSky(pipeline_, targets_, shadingInputs(input), {input.fogDistance, isNight});
    }
    const TimerZone zone(timer_, "shade");
    passes_.shading.drawSurfaces(pipeline_, targets_, shadingInputs(input), passes_.occlusion);
}

// Costs nothing if no mesh section in view has blended faces, and returns false.
bool Renderer::drawTransparency(const FrameInput& input) {
    const ViewMatrices view = viewMatrices(input.camera, aspectOf(targets_.size));
    if (options_.transparencyLayers == 0) return false;
    const std::vector<ScreenRect> rects =
        meshSections_.blendedRects(cameraChunk(input.camera), view.viewProjection, targets_.size);
    if (rects.empty()) return false;
    {
        const TimerZone zone(timer_, "peel");
        passes_.transparency.peelLayers(pipeline_, targets_, quadDraw(), rects);
    }
    const TimerZone zone(timer_, "shade layers");
    passes_.transparency.shade(pipeline_, targets_, quadDraw(), shadingInputs(input), passes_.occlusion,
                               rects);
    return true;
}

// `depth`: of the nearest surfaces.
void Renderer::drawFinal(const MsaaTexture& depth) {
    const TimerZone zone(timer_, "final");
    depth.bind(shared::kDepthUnit);
    targets_.sceneColor.bind(shared::kSceneUnit);
    if (passes_.occlusion.isOn()) passes_.occlusion.result().bind(shared::kOcclusionUnit);
    if (passes_.godRays.isOn()) passes_.godRays.bindResult();
    if (passes_.depthOfField.isOn()) passes_.depthOfField.bindResult();
    targets_.ldr.bind();
    passes_.finalPass.draw(pipeline_, {});
}

void Renderer::drawImage(const FrameInput& input) {
    if (passes_.occlusion.isOn()) {
        const TimerZone zone(timer_, "ambient occlusion");
        passes_.occlusion.draw(pipeline_, targets_);
    }
    shadeSurfaces(input);
    // The depth of water is that of its surface, not of its ground.
    const bool hasLayers = drawTransparency(input);
    if (isDirectImage(options_, targets_.msaaSamples)) return;
    const MsaaTexture& depth = hasLayers ? passes_.transparency.nearestDepth() : targets_.depth;
    if (passes_.godRays.isOn()) {
        const TimerZone zone(timer_, "god rays");
        passes_.godRays.draw(pipeline_, targets_);
    }
    if (passes_.depthOfField.isOn()) {
        const TimerZone zone(timer_, "depth of field");
        passes_.depthOfField.draw(pipeline_, targets_, depth);
    }
    drawFinal(depth);
}

void Renderer::drawDebugView() {
    targets_.bindGBuffer();
    light_.bind();
    targets_.ldr.bind();
    passes_.debugView.draw(pipeline_, {});
}

void Renderer::draw(const FrameInput& input) {
    TERRANE_ZONE("draw frame");
    base::require(targets_.size.x > 0, "Renderer::draw: configure() comes before the first frame");
    const ViewMatrices view = viewMatrices(input.camera, aspectOf(targets_.size));
    timer_.nextFrame();
    ring_.beginFrame();
    pipeline_.forget();
    bindFrame(input, view);
    CullInput culling = cullInput(input, view);
    meshSections_.update(culling.cameraChunk);
    const bool leavesOutHidden = passes_.hiZ.isOn() && !input.culledFor;
    if (leavesOutHidden) culling.hiZ = &passes_.hiZ;
    cull(leavesOutHidden ? CullPhase::Early : CullPhase::All, culling);
    drawShadows(input);
    drawSurfaces();
    if (leavesOutHidden) drawLate(culling);
    if (passes_.holeFill.isOn()) {
        const TimerZone zone(timer_, "fill holes");
        passes_.holeFill.draw(pipeline_, targets_);
    }
    drawFigures(input, culling);
    input.view == View::Color ? drawImage(input) : drawDebugView();
    pipeline_.set({});  // code outside may clear depths
    gpu::Program::useNone();
    passes_.cull.queueCounts();
    ring_.endFrame();
}

std::size_t Renderer::shadowTriangles(const FrameInput& input) const {
    return countShadowTriangles(quads_, input.camera, viewMatrices(input.camera, aspectOf(targets_.size)),
                                input.environment.lightDirection);
}

void Renderer::presentToWindow(glm::ivec2 windowSize) const {
    gpu::blitToWindow(targets_.ldr, 0, windowSize, size() == windowSize ? GL_NEAREST : GL_LINEAR);
}

// Chunks of the renderer and their memory budget.

namespace {

// Share of the budget for records of mesh sections and draw commands, which grow with the world: quads and
// light leave it free. They take about a twelfth of the size of quads and light.
constexpr std::size_t kRecordsShare = 8;

// Share for the first buffer of quads, which is seldom full.
constexpr std::size_t kFirstQuadsShare = 16;

// Light's share of the memory of quads and light: a chunk of a landscape has 28 KB of light and 8 KB of
// quads.
std::size_t lightShare(std::size_t bytes) {
    return bytes / 4 * 3;
}

}  // namespace

GpuMemory Renderer::memory() const {
    return {.quads = quads_.bufferBytes(),
            .light = light_.textureBytes(),
            .meshSections = meshSections_.gpuBytes() + passes_.cull.gpuBytes(meshSections_),
            .textures = resources_.gpuBytes() + noise_.gpuBytes() + sky_.gpuBytes() + tints_.gpuBytes() +
                        land_.gpuBytes(),
            .targets = targets_.gpuBytes() + passes_.targetBytes(),
            .staging = stagingBytes_};
}

void Renderer::setMemoryBudget(std::size_t bytes) {
    budgetBytes_ = bytes;
    peakBytes_ = 0;
    const std::size_t firstQuads = bytes / kFirstQuadsShare / shared::kQuadBytes;
    quadSizes_.firstQuads =
        static_cast<std::uint32_t>(std::clamp<std::size_t>(firstQuads, 1, QuadStoreSizes().firstQuads));
    clearChunks();
}

// Comes before quads or light may grow: both get the remaining memory.
void Renderer::shareBudget() {
    if (budgetBytes_ == SIZE_MAX) return;
    const GpuMemory used = memory();
    const std::size_t records = std::max(used.meshSections, budgetBytes_ / kRecordsShare);
    const std::size_t taken = used.fixed() + used.quads + used.light + records;
    const std::size_t room = budgetBytes_ - std::min(budgetBytes_, taken);
    quads_.setMaxBytes(used.quads + room);
    light_.setMaxBytes(used.light + room);
}

void Renderer::notePeak() {
    const GpuMemory used = memory();
    const std::size_t others = used.total() - used.quads - used.light;
    peakBytes_ = std::max(peakBytes_, others + quads_.takePeakBytes() + light_.takePeakBytes());
}

void Renderer::showQuads(world::ChunkPos pos, mesh::MeshSectionSet changed) {
    if (!hidden_.contains(pos)) meshSections_.set(pos, quads_.meshSectionsOf(pos), changed);
}

void Renderer::setShown(world::ChunkPos pos, bool isShown) {
    if (isShown) {
        if (hidden_.erase(pos) > 0) showQuads(pos, mesh::kAllMeshSections);
    } else if (hidden_.insert(pos).second) {
        meshSections_.remove(pos);
    }
}

bool Renderer::setChunk(world::ChunkPos pos, const mesh::ChunkMesh& mesh, mesh::MeshSectionSet meshSections) {
    shareBudget();
    const bool hasRoom = quads_.set(pos, mesh, meshSections);
    showQuads(pos, meshSections);
    notePeak();
    return hasRoom;
}

bool Renderer::reserveChunk(world::ChunkPos pos, std::span<const mesh::MeshSection> meshes) {
    shareBudget();
    const bool hasRoom = quads_.reserve(pos, meshes);
    showQuads(pos, mesh::kAllMeshSections);
    notePeak();
    return hasRoom;
}

bool Renderer::setLight(world::ChunkPos pos, const light::ChunkLight& light, std::uint16_t bricks) {
    shareBudget();
    const bool hasRoom = light_.set(pos, light, bricks);
    notePeak();
    return hasRoom;
}

void Renderer::removeChunk(world::ChunkPos pos) {
    meshSections_.remove(pos);
    hidden_.erase(pos);
    quads_.remove(pos);
    light_.remove(pos);
}

void Renderer::setViewDistance(int chunks) {
    viewDistance_ = chunks;
    light_ = {};  // before the new one takes memory
    std::size_t mostBytes = SIZE_MAX;
    if (budgetBytes_ != SIZE_MAX) {
        const GpuMemory used = memory();
        const std::size_t taken = used.fixed() + std::max(used.meshSections, budgetBytes_ / kRecordsShare);
        const std::size_t room = budgetBytes_ - std::min(budgetBytes_, taken);
        mostBytes = std::min(lightShare(room), room - std::min(room, used.quads));
    }
    light_ = LightStore(chunks, 0, mostBytes);
    notePeak();
}

void Renderer::clearChunks() {
    quads_ = QuadStore({.arenaQuads = 1});  // before the new one takes memory
    quads_ = QuadStore(quadSizes_);
    hidden_.clear();
    meshSections_ = MeshSectionTable(quads_.ranges().arenaSize());
    passes_.shadowMap.forget();
    passes_.cull.forget();
    setViewDistance(viewDistance_);
}

}  // namespace terrane::render
