// Draws the world as the camera sees it. Owns the quads and the light of the visible chunks, the passes of a
// frame and the targets they draw into, and runs the passes in order. Used on the thread of the current
// OpenGL context.
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <unordered_set>

#include "terrane/base/image.h"
#include "terrane/gpu/timer.h"
#include "terrane/render/block_textures.h"
#include "terrane/render/frame_input.h"
#include "terrane/render/frame_passes.h"
#include "terrane/render/frame_statistics.h"
#include "terrane/render/gpu_memory.h"
#include "terrane/render/land_textures.h"
#include "terrane/render/light_store.h"
#include "terrane/render/quad_draw.h"
#include "terrane/render/shading_inputs.h"
#include "terrane/render/sky_texture.h"
#include "terrane/render/tint_textures.h"

namespace terrane::render {

class Renderer {
  public:
    // The loader outlives the renderer.
    static base::Result<Renderer> create(const gpu::ShaderLoader& shaders, const world::BlockRegistry& blocks,
                                         const TextureSource& textures, const gpu::DeviceInfo& device,
                                         const QuadStoreSizes& quads = {});

    // Other textures for the same blocks, from the next frame on. Where one is wrong those before stay.
    base::Result<void> setTextures(const world::BlockRegistry& blocks, const TextureSource& textures);

    // Size of the image in pixels and how it is drawn. Comes before the first frame and whenever something
    // changes. Fails where the driver cannot; what was before then stays.
    base::Result<void> configure(glm::ivec2 size, const RenderOptions& options);
    const RenderOptions& options() const { return options_; }
    // Shaders as the loader gives them now, from the next frame on. Where one is wrong those before stay.
    base::Result<void> reloadShaders();

    // The most bytes that all of this may take on the GPU: quads and light grow no further. Comes before
    // configure(), which takes what it needs, and setViewDistance(); chunks are forgotten.
    void setMemoryBudget(std::size_t bytes);
    std::size_t memoryBudget() const { return budgetBytes_; }
    GpuMemory memory() const;  // as of the next frame
    // The most at once since setMemoryBudget(), with copies while something grows.
    std::size_t peakMemory() const { return peakBytes_; }
    // Memory of others that the budget counts.
    void setStagingBytes(std::size_t bytes) { stagingBytes_ = bytes; }

    // The next frame shows these mesh sections of the chunk so; of others `mesh` has no quads. False where
    // there is no room within the budget: the mesh sections are not shown then.
    bool setChunk(world::ChunkPos pos, const mesh::ChunkMesh& mesh,
                  mesh::MeshSectionSet meshSections = mesh::kAllMeshSections);
    // The same of the whole chunk, but for the quads: before the next frame a shader writes them into
    // quadBuffers(), to where meshSectionsOf() says.
    bool reserveChunk(world::ChunkPos pos, std::span<const mesh::MeshSection> meshes);
    std::span<const mesh::MeshSection> meshSectionsOf(world::ChunkPos pos) const {
        return quads_.meshSectionsOf(pos);
    }
    gpu::ArenaBuffers quadBuffers() const { return quads_.buffers(); }  // until the next change
    // Of chunks of level 0. Chunks without light are drawn as under the open sky. `viewDistance` of
    // setViewDistance is the farthest that light is kept for. `bricks` and result: see LightStore.
    bool setLight(world::ChunkPos pos, const light::ChunkLight& light, std::uint16_t bricks = 0xFFFF);
    void removeChunk(world::ChunkPos pos);
    // Whether tinted faces take a tint from now on; it is neutral where no tile is set, and all tiles are
    // forgotten. Fails where the shaders cannot be compiled; then it is as before.
    base::Result<void> useTint(bool isUsed);
    bool hasTint() const { return tints_.isUsed(); }
    // The tint of a tile that tintClipmap().isTile(), after useTint(true).
    void setTint(world::ChunkPos tile, const world::TintTile& colors) { tints_.set(tile, colors); }
    const Clipmap& tintClipmap() const { return tints_.clipmap(); }
    // Whether light knows the land as far as the horizon from now on (land_map.h); all of its tiles are
    // forgotten. Fails as useTint().
    base::Result<void> useLand(bool isUsed);
    bool hasLand() const { return land_.isUsed(); }
    // After useLand(true): the surface of a tile that the clipmap has; how far one sees, blocks.
    void setLand(world::ChunkPos tile, const world::LandTile& land) { land_.map().set(tile, land); }
    void setLandReach(double blocks) { land_.map().setReach(blocks); }
    const Clipmap& landClipmap() const { return land_.map().clipmap(); }
    // The next frame takes in all that was set, whatever it takes; others compute a level at most.
    void completeLand() { completesLand_ = true; }
    // A chunk that is not shown keeps its quads and its light. Chunks are shown unless told otherwise, which
    // may come before they are set; removeChunk() ends it.
    void setShown(world::ChunkPos pos, bool isShown);
    // Makes room for light; what was set is forgotten.
    void setViewDistance(int chunks);
    // Forgets all chunks. Their memory is given back but for the least that there is at first.
    void clearChunks();

    // Draws into the renderer's own image.
    void draw(const FrameInput& input);

    base::Image readImage() const { return gpu::readPixels(targets_.ldr); }  // waits for the GPU
    void presentToWindow(glm::ivec2 windowSize) const;

    // Of the newest frame that the GPU has finished.
    FrameStatistics statistics() {
        return statisticsOf(passes_.cull.counts(), passes_.shadowMap.drawnTriangles());
    }
    const std::vector<gpu::GpuTiming>& passTimes() const { return timer_.results(); }
    // What a shadow map for this frame would draw.
    std::size_t shadowTriangles(const FrameInput& input) const;
    std::size_t quadBytes() const { return quads_.usedBytes(); }
    std::uint64_t uploadedQuadBytes() const { return quads_.uploadedBytes(); }  // since the beginning
    const world::TopColors& topColors() const { return topColors_; }            // of the textures in use
    std::size_t lightBytes() const { return light_.usedBytes(); }
    std::size_t chunkCount() const { return std::max(light_.chunkCount(), quads_.chunks().size()); }
    glm::ivec2 size() const { return targets_.size; }

  private:
    base::Result<void> configurePasses(const FrameTargets& targets, const RenderOptions& options,
                                       const QuadFeatures& features);
    QuadFeatures features() const { return {resources_.hasFaceSampling(), tints_.isUsed(), land_.isUsed()}; }
    void bindFrame(const FrameInput& input, const ViewMatrices& view);
    CullInput cullInput(const FrameInput& input, const ViewMatrices& view) const;
    void cull(CullPhase phase, const CullInput& input);
    void drawShadows(const FrameInput& input);
    void drawSurfaces();
    void drawLate(const CullInput& cullInput);
    void drawFigures(const FrameInput& input, const CullInput& cullInput);
    void shadeSurfaces(const FrameInput& input);
    bool drawTransparency(const FrameInput& input);
    void drawImage(const FrameInput& input);
    void drawFinal(const MsaaTexture& depth);
    void drawDebugView();
    QuadDraw quadDraw();
    ShadingInputs shadingInputs(const FrameInput& input) const;
    bool hasShadows(const FrameInput& input) const;
    void showQuads(world::ChunkPos pos, mesh::MeshSectionSet changed);
    void shareBudget();
    void notePeak();

    RenderOptions options_;
    FrameTargets targets_;
    QuadStore quads_{{.arenaQuads = 1}};  // until clearChunks()
    MeshSectionTable meshSections_;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> hidden_;  // chunks that are not shown
    LightStore light_;
    QuadResources resources_;
    TintTextures tints_;
    LandTextures land_;
    world::TopColors topColors_;
    bool completesLand_ = false;
    gpu::MappedRing ring_;
    gpu::GpuTimer timer_;
    gpu::Pipeline pipeline_;

    FramePasses passes_;
    SkyNoise noise_;
    SkyTexture sky_;

    const gpu::ShaderLoader* shaders_ = nullptr;
    gpu::DeviceInfo device_;
    QuadStoreSizes quadSizes_;
    int viewDistance_ = 0;  // chunks
    std::size_t budgetBytes_ = SIZE_MAX, stagingBytes_ = 0, peakBytes_ = 0;
};

}  // namespace terrane::render
