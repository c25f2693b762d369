#include "terrane/render/frame/renderer.h"

#include <algorithm>
#include <glm/common.hpp>
#include <span>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/gpu/program.h"
#include "terrane/render/figures/figure_pass.h"
#include "terrane/render/frame/edge_expansion.h"
#include "terrane/render/frame/frame_statistics.h"
#include "terrane/render/frame/frame_uniforms.h"
#include "terrane/render/shadow/shadow_volume.h"
#include "terrane/shared/bindings.h"

namespace terrane::render {

namespace {

// Uniforms of a frame (camera, tint, air, land, shadows), those of culling twice, and those of the shadow map
// rectangles that figures are drawn into, aligned; then the figures in view, and those that cast shadows.
constexpr std::size_t kRingBytes = 8192 + ShadowMap::kFigureRingBytes + 2 * FigurePass::kRingBytes;
constexpr int kFirstViewDistance = 4;  // chunks, until setViewDistance: the smallest store of light
constexpr float kMaxAnisotropy = 8.0f;

// Least light that casts shadows, linear: between sun and moon the light is too dark to see.
constexpr float kMinShadowedLight = 0.002f;

}  // namespace

base::Result<Renderer> Renderer::create(const gpu::ShaderLoader& shaders, const world::BlockRegistry& blocks,
                                        const TextureSource& textures, const gpu::DeviceInfo& device,
                                        const QuadStoreSizes& quads, int maxTextureSide) {
    const TextureLimits limits{device.maxArrayLayers, maxTextureSide};
    auto blockTextures = TERRANE_TRY(loadBlockTextures(blocks, textures, limits));
    auto topColors = TERRANE_TRY(world::topColors(blocks, textures));
    auto cull = TERRANE_TRY(CullPass::create(shaders, device, quads.limits));

    Renderer renderer;
    renderer.topColors_ = std::move(topColors);
    // Software renderers take time for each sample.
    const float anisotropy = device.software ? 1.0f : std::min(kMaxAnisotropy, device.maxAnisotropy);
    renderer.resources_ = QuadResources(blocks, std::move(blockTextures), anisotropy);
    renderer.cull_ = std::move(cull);
    renderer.programs_ = std::make_unique<Programs>(shaders);
    renderer.fullscreen_ = gpu::VertexArray("fullscreen");
    renderer.noise_ = SkyNoise::create();
    renderer.sky_ = SkyTexture::create();
    renderer.ring_ = gpu::MappedRing(kRingBytes, "frame data");
    if (!renderer.ring_.isMapped())
        return base::fail(base::ErrorCode::OutOfResources,
                          "the graphics driver has no memory for frame data");
    renderer.viewDistance_ = kFirstViewDistance;
    renderer.quadSizes_ = quads;
    renderer.clearChunks();
    renderer.shaders_ = &shaders;
    renderer.blocks_ = std::make_shared<const world::BlockRegistry>(blocks);
    renderer.device_ = device;
    renderer.textureLimits_ = limits;
    return renderer;
}

base::Result<void> Renderer::setTextures(const world::BlockRegistry& blocks, const TextureSource& textures) {
    auto loaded = TERRANE_TRY(loadBlockTextures(blocks, textures, textureLimits_));
    auto colors = TERRANE_TRY(world::topColors(blocks, textures));
    FrameSpec spec = frame_.spec;
    spec.features.hasFaceSampling = needsFaceSampling(blocks, loaded);
    TERRANE_TRY(rebuild(spec));
    topColors_ = std::move(colors);
    if (land_.isUsed())
        land_ = LandTextures::create(topColors_, heights_);  // its tiles come again, with these colors
    resources_.setTextures(blocks, std::move(loaded));
    forgetShadows();
    return {};
}

// Does nothing before the first configure().
base::Result<void> Renderer::rebuild(const FrameSpec& spec) {
    if (spec.size.x == 0 || spec == frame_.spec) return {};
    frame_ = TERRANE_TRY(buildFrame(spec, *programs_, frame_));
    return {};
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
    const glm::ivec2 drawn = glm::max((size * options.renderScale + 50) / 100, glm::ivec2(1));
    const glm::ivec2 larger = glm::max(size, drawn);
    if (std::max(larger.x, larger.y) > device_.maxTextureSize) {
        return base::fail("{} × {} pixels: the graphics driver has at most {} per side", larger.x, larger.y,
                          device_.maxTextureSize);
    }
    Upscaling upscaling = options.upscaling;
    if (upscaling == Upscaling::Auto) upscaling = device_.software ? Upscaling::Linear : Upscaling::Edges;
    const bool isLoop = !device_.indirectDraws || (options.draw == DrawMethod::Auto && device_.software) ||
                        options.draw == DrawMethod::Loop;
    if (options.surfaces == SurfaceMethod::Rays && options.shading == Shading::Corners)
        return base::fail(base::ErrorCode::BadInput,
                          "rays find surfaces without quads, at whose corners they could be shaded: choose "
                          "another shading or preset than corners and minimal");
    const FrameSpec before = frame_.spec;
    TERRANE_TRY(rebuild(
        {drawn, size, options, features(), isLoop ? DrawMethod::Loop : DrawMethod::Indirect, upscaling}));
    const auto lit = useCornerLight(options.shading == Shading::Corners);
    if (!lit) {
        TERRANE_TRY(rebuild(before));
        return lit;
    }
    if (readsBlocks() != rays_.isUsed()) makeRays(readsBlocks());
    return {};
}

base::Result<void> Renderer::reloadShaders() {
    auto programs = std::make_unique<Programs>(*shaders_);
    auto cull = TERRANE_TRY(CullPass::create(*shaders_, device_, quadSizes_.limits));
    if (frame_.isBuilt()) frame_ = TERRANE_TRY(buildFrame(frame_.spec, *programs, frame_));
    programs_ = std::move(programs);
    cull_ = std::move(cull);
    return {};
}

base::Result<void> Renderer::useTint(bool isUsed) {
    FrameSpec spec = frame_.spec;
    spec.features.hasTint = isUsed;
    TERRANE_TRY(rebuild(spec));
    tints_ = isUsed ? TintTextures::create() : TintTextures();
    return {};
}

base::Result<void> Renderer::useLand(bool isUsed) {
    FrameSpec spec = frame_.spec;
    spec.features.hasLand = isUsed;
    TERRANE_TRY(rebuild(spec));
    land_ = isUsed ? LandTextures::create(topColors_, heights_) : LandTextures();
    return {};
}

bool Renderer::hasShadows(const FrameInput& input) const {
    const glm::vec3 light = input.environment.lightColor;
    const bool isLit = std::max({light.x, light.y, light.z}) > kMinShadowedLight;
    return frame_.shadowMap && input.view == View::Color && isLit;
}

void Renderer::writeUniforms(const FrameInput& input, const ViewMatrices& view) {
    shared::Frame frame =
        frameUniforms(input, frame_.drawn,
                      {view, glm::vec2(drawnSize()), edgeExpansion(device_.subpixelBits, drawnSize())});
    const world::ChunkPos chunk = cameraChunk(input.camera);
    const int mask = light_.gridChunks() - 1;
    constexpr int kTilesOfChunk = static_cast<int>(shared::kChunkSize / shared::kLightTileSize);
    frame.firstLightTile = {kTilesOfChunk * (chunk.x & mask), kTilesOfChunk * (chunk.y & mask)};
    frame.lightGridTiles = kTilesOfChunk * light_.gridChunks();
    frame.bottom = heights_.bottom;
    frame.top = heights_.top;
    ring_.writeUniform(shared::kFrameBinding, frame);
    tints_.writeUniforms(input.camera, ring_);
    sky_.update(input.environment, airLevels_, view.cameraPosition.z, ring_);
    const int levels = std::exchange(completesLand_, false) ? LandTextures::kAllLevels : 1;
    if (!readsLand()) return;
    land_.update(input.camera, {input.environment.lightDirection, input.environment.discRadius}, levels);
    land_.writeUniforms(input.camera, ring_);
}

CullInput Renderer::cullInput(const FrameInput& input, const ViewMatrices& view) {
    CullInput cull{cameraChunk(input.camera), view.cameraPosition, frustumOf(view.viewProjection),
                   view.viewProjection, glm::vec2(drawnSize())};
    cull.quads = &quads_;
    cull.resources = &resources_;
    cull.edgeExpansion = edgeExpansion(device_.subpixelBits, drawnSize());
    cull.blockPixels = 0.5f * cull.size.y / glm::length(view.up);
    cull.samples = frame_.samples;
    cull.hidesBacks = !frame_.drawn.leafBacks;
    cull.method = frame_.spec.draw;
    if (input.cullingCamera)
        cull.camera = frustumOf(viewMatrices(*input.cullingCamera, aspectOf(size())).viewProjection);
    else if (frame_.targets.hiZ)
        cull.hiZ = &frame_.targets.hiZ->plain();
    return cull;
}

// Writes what all passes read, and collects what they draw with.
FrameContext Renderer::prepare(const FrameInput& input) {
    const ViewMatrices view = viewMatrices(input.camera, aspectOf(size()));
    writeUniforms(input, view);
    meshSections_.update(cameraChunk(input.camera));
    const bool isShadowed = hasShadows(input);
    const auto changes = meshSections_.takeChanges();
    if (frame_.shadowMap) {
        frame_.shadowMap->markChanged(changes);
        if (!isShadowed) frame_.shadowMap->writeUniforms(input.camera, false, ring_);
    }
    FrameContext context{.frame = frame_,
                         .input = input,
                         .view = view,
                         .pipeline = pipeline_,
                         .ring = ring_,
                         .quads = quads_,
                         .resources = resources_,
                         .meshSections = meshSections_,
                         .cull = cull_,
                         .figures = figures_,
                         .rays = rays_,
                         .fullscreen = fullscreen_,
                         .culling = cullInput(input, view),
                         .hasShadows = isShadowed,
                         .top = heights_.top,
                         .cloudsZ = airLevels_.clouds,
                         .nearestDepth = frame_.targets.depth.get()};
    light_.addTo(context.worldTextures);
    noise_.addTo(context.worldTextures);
    sky_.addTo(context.worldTextures);
    tints_.addTo(context.worldTextures);
    land_.addTo(context.worldTextures);
    return context;
}

void Renderer::draw(const FrameInput& input) {
    TERRANE_ZONE("draw frame");
    base::require(frame_.isBuilt(), "Renderer::draw: configure() comes before the first frame");
    timer_.nextFrame();
    ring_.beginFrame();
    pipeline_.invalidate();
    lightCorners(input.maxLitChunks);
    if (rays_.isUsed()) rays_.update(cameraChunk(input.camera));
    FrameContext context = prepare(input);
    recordPasses(context, timer_);
    pipeline_.set({});  // code outside may clear depths
    gpu::Program::useNone();
    if (frame_.drawn.surfaces == SurfaceMethod::Quads) cull_.endFrame();
    ring_.endFrame();
}

std::size_t Renderer::shadowTriangles(const FrameInput& input) const {
    return countShadowTriangles(quads_, input.camera, viewMatrices(input.camera, aspectOf(size())),
                                input.environment.lightDirection);
}

void Renderer::presentToWindow(glm::ivec2 windowSize) const {
    gpu::blitToWindow(*frame_.output, 0, windowSize, size() == windowSize ? GL_NEAREST : GL_LINEAR);
}

void Renderer::setHeights(world::Heights heights) {
    if (heights == heights_) return;
    heights_ = heights;
    if (land_.isUsed()) land_ = LandTextures::create(topColors_, heights_);
    clearChunks();
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
            .rays = rays_.gpuBytes(),
            .meshSections = meshSections_.gpuBytes() + cull_.gpuBytes(meshSections_, frame_.spec.draw),
            .textures = resources_.gpuBytes() + noise_.gpuBytes() + sky_.gpuBytes() + tints_.gpuBytes() +
                        land_.gpuBytes(),
            .targets = frame_.targetBytes(),
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
    // What doubles exists twice for a while.
    const std::size_t growing = meshSections_.gpuBytes() + cull_.listBytes();
    const std::size_t records = std::max(used.meshSections + 2 * growing, budgetBytes_ / kRecordsShare);
    const std::size_t taken = used.fixed() + used.quads + used.light + records;
    const std::size_t room = budgetBytes_ - std::min(budgetBytes_, taken);
    quads_.setMaxBytes(used.quads + room);
    light_.setMaxBytes(used.light + room);
    rays_.setMaxBytes(used.rays + room);
}

void Renderer::notePeak() {
    const GpuMemory used = memory();
    const std::size_t others = used.total() - used.quads - used.light;
    peakBytes_ = std::max(peakBytes_, others + quads_.takePeakBytes() + light_.takePeakBytes());
}

void Renderer::showQuads(world::ChunkPos pos, const mesh::MeshSectionSet& changed) {
    if (!hidden_.contains(pos)) meshSections_.set(pos, quads_.meshSectionsOf(pos), changed);
}

void Renderer::makeRays(bool isUsed) {
    rays_ = isUsed ? RayStore(*blocks_, heights_, viewDistance_) : RayStore();
    for (const world::ChunkPos pos : hidden_)
        if (isUsed) rays_.setShown(pos, false);
}

bool Renderer::setBlocks(world::ChunkPos pos, world::ChunkPtr blocks) {
    if (!rays_.isUsed()) return true;
    shareBudget();
    return rays_.set(pos, std::move(blocks));
}

void Renderer::setShown(world::ChunkPos pos, bool isShown) {
    if (rays_.isUsed()) rays_.setShown(pos, isShown);
    if (isShown) {
        if (hidden_.erase(pos) > 0) showQuads(pos, mesh::kAllMeshSections);
    } else if (hidden_.insert(pos).second) {
        meshSections_.remove(pos);
    }
}

bool Renderer::setLitQuads(const CornerLitChunks::Change& change) {
    const bool hasRoom = quads_.set(change.pos, change.lit.mesh, change.meshSections, change.lit.light);
    showQuads(change.pos, change.meshSections);
    return hasRoom;
}

// Tiles of far land are in daylight: theirs does not change.
bool Renderer::setQuads(world::ChunkPos pos, const mesh::ChunkMesh& mesh,
                        const mesh::MeshSectionSet& meshSections) {
    const std::vector<shared::ShapeFace>& shapeFaces = resources_.tables().shapeFaces;
    if (quads_.hasLight() && pos.level == 0) {
        cornerLit_.setMesh(pos, mesh, meshSections);
        return setLitQuads(cornerLit_.light(pos, shapeFaces));
    }
    if (quads_.hasLight()) return setLitQuads({pos, meshSections, litAtCorners(mesh, {}, shapeFaces)});
    const bool hasRoom = quads_.set(pos, mesh, meshSections);
    showQuads(pos, meshSections);
    return hasRoom;
}

bool Renderer::setChunk(world::ChunkPos pos, const mesh::ChunkMesh& mesh,
                        const mesh::MeshSectionSet& meshSections) {
    if (meshSections == mesh::kAllMeshSections) {
        unread_.erase(pos);
    } else {
        readWritten(pos);
    }
    if (!readsQuads()) return true;
    shareBudget();
    const bool hasRoom = setQuads(pos, mesh, meshSections);
    notePeak();
    return hasRoom;
}

// Takes over quads that a shader wrote since they were reserved.
void Renderer::readWritten(world::ChunkPos pos) {
    if (unread_.erase(pos) > 0 && quads_.chunks().contains(pos)) setChunk(pos, quads_.meshOf(pos));
}

// Lights quads that shaders wrote, and those of up to `maxChunks` chunks whose light changed. Where there is
// no room for more quads, they stay whole.
void Renderer::lightCorners(int maxChunks) {
    if (!quads_.hasLight()) return;
    const std::vector<world::ChunkPos> written(unread_.begin(), unread_.end());
    for (const world::ChunkPos pos : written) readWritten(pos);
    const std::vector<shared::ShapeFace>& shapeFaces = resources_.tables().shapeFaces;
    shareBudget();
    for (int k = 0; k < maxChunks; ++k) {
        const auto change = cornerLit_.lightNext(shapeFaces);
        if (!change) break;
        if (!setLitQuads(*change) && !setLitQuads(cornerLit_.unsplit(*change, shapeFaces)))
            base::logWarning("no room for chunk {},{} with other light", change->pos.x, change->pos.y);
    }
    notePeak();
}

bool Renderer::setAllQuads(bool isLit, const ChunkMeshes& meshes) {
    quads_ = QuadStore({.arenaQuads = 1});  // before the new one takes memory
    quadSizes_.hasLight = isLit;
    QuadStoreSizes sizes = quadSizes_;
    if (isLit) sizes.firstQuads = std::max(1u, sizes.firstQuads / 2);  // as many bytes
    quads_ = QuadStore(sizes);
    cornerLit_.clearMeshes();
    unread_.clear();
    meshSections_ = MeshSectionTable(quads_.ranges().arenaSize());
    forgetShadows();
    cull_.invalidate();
    bool hasRoom = true;
    for (const auto& [pos, mesh] : meshes) hasRoom &= setChunk(pos, mesh);
    return hasRoom;
}

// Makes the quads anew, with light at their corners or without.
base::Result<void> Renderer::useCornerLight(bool isUsed) {
    if (isUsed == quads_.hasLight()) return {};
    const auto noRoom = [&] {
        return base::fail(base::ErrorCode::OutOfResources,
                          "no room for light at the corners of quads within {} MiB of GPU memory",
                          budgetBytes_ >> 20);
    };
    lightCorners(0);
    shareBudget();
    // Twice as large, split, and with what growing leaves unused.
    constexpr std::size_t kTimesLarger = 3;
    if (isUsed && quads_.usedBytes() > quads_.maxBytes() / kTimesLarger) return noRoom();
    ChunkMeshes meshes;
    for (const auto& [pos, meshSections] : quads_.chunks()) {
        const mesh::ChunkMesh* known = cornerLit_.meshOf(pos);
        meshes.emplace_back(pos, known ? *known : quads_.meshOf(pos));
    }
    if (setAllQuads(isUsed, meshes)) return {};
    if (!setAllQuads(!isUsed, meshes)) base::logWarning("no room for all chunks that were shown before");
    return noRoom();
}

bool Renderer::reserveChunk(world::ChunkPos pos, std::span<const mesh::MeshSection> meshes) {
    shareBudget();
    cornerLit_.removeMesh(pos);
    const bool hasRoom = quads_.reserve(pos, meshes);
    if (quads_.hasLight()) unread_.insert(pos);
    showQuads(pos, mesh::kAllMeshSections);
    notePeak();
    return hasRoom;
}

bool Renderer::setLight(world::ChunkPos pos, const light::ChunkLight& light) {
    return setLight(pos, light, world::SectionSet::all(heights_));
}

bool Renderer::setLight(world::ChunkPos pos, const light::ChunkLight& light,
                        const world::SectionSet& bricks) {
    shareBudget();
    const bool hasRoom = light_.set(pos, light, bricks);
    cornerLit_.setLight(pos, light, bricks);
    notePeak();
    return hasRoom;
}

void Renderer::removeChunk(world::ChunkPos pos) {
    if (rays_.isUsed()) rays_.remove(pos);
    meshSections_.remove(pos);
    hidden_.erase(pos);
    quads_.remove(pos);
    light_.remove(pos);
    cornerLit_.remove(pos);
    unread_.erase(pos);
}

void Renderer::setViewDistance(int chunks) {
    viewDistance_ = chunks;
    if (rays_.isUsed()) rays_.setViewDistance(chunks);
    light_ = {};  // before the new one takes memory
    std::size_t mostBytes = SIZE_MAX;
    if (budgetBytes_ != SIZE_MAX) {
        const GpuMemory used = memory();
        const std::size_t taken = used.fixed() + std::max(used.meshSections, budgetBytes_ / kRecordsShare);
        const std::size_t room = budgetBytes_ - std::min(budgetBytes_, taken);
        mostBytes = std::min(lightShare(room), room - std::min(room, used.quads));
    }
    light_ = LightStore(chunks, 0, mostBytes, heights_);
    notePeak();
}

void Renderer::clearChunks() {
    cornerLit_ = {};
    setAllQuads(quadSizes_.hasLight, {});
    hidden_.clear();
    makeRays(rays_.isUsed());
    setViewDistance(viewDistance_);
}

}  // namespace terrane::render
