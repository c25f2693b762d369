// Draws the view of the camera. Owns the world on the GPU (quads, light, textures) and the frame (frame.h)
// that is built for the options. It is used on the thread of the current OpenGL context.
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <unordered_set>

#include "terrane/base/image.h"
#include "terrane/gpu/timer.h"
#include "terrane/render/cull/cull_pass.h"
#include "terrane/render/frame/frame.h"
#include "terrane/render/frame/frame_statistics.h"
#include "terrane/render/frame/frame_uniforms.h"
#include "terrane/render/land/land_textures.h"
#include "terrane/render/land/tint_textures.h"
#include "terrane/render/quads/block_textures.h"
#include "terrane/render/quads/corner_lit_chunks.h"
#include "terrane/render/quads/light_store.h"
#include "terrane/render/rays/ray_store.h"
#include "terrane/render/sky/sky_texture.h"

namespace terrane::render {

class Renderer {
  public:
    // Creates a renderer. The loader outlives it. `maxTextureSide` limits the textures on the GPU, in pixels.
    static base::Result<Renderer> create(const gpu::ShaderLoader& shaders, const world::BlockRegistry& blocks,
                                         const TextureSource& textures, const gpu::DeviceInfo& device,
                                         const QuadStoreSizes& quads = {},
                                         int maxTextureSide = TextureLimits().side);

    // Replaces the textures, for the same blocks, from the next frame on. On failure the old ones stay.
    base::Result<void> setTextures(const world::BlockRegistry& blocks, const TextureSource& textures);

    // Sets the size of the image in pixels, as readImage() and presentToWindow() have it, and the options.
    // Comes before the first frame and whenever one of them changes. If the driver does not support them it
    // fails, and the old configuration stays.
    base::Result<void> configure(glm::ivec2 size, const RenderOptions& options);
    const RenderOptions& options() const { return frame_.spec.options; }
    // Loads all shaders again, for the next frame. On failure the old ones stay.
    base::Result<void> reloadShaders();

    // Sets the heights of the world that is drawn, 0…255 at first. Comes before its chunks; removes all
    // chunks and the tiles of the land.
    void setHeights(world::Heights heights);
    // Sets where sea and clouds of the world that is drawn lie, from the next frame on.
    void setAirLevels(const world::AirLevels& levels) { airLevels_ = levels; }

    // Sets the most bytes that the renderer may take on the GPU: quads and light do not grow beyond it. Comes
    // before configure() and setViewDistance(), which allocate memory; removes all chunks.
    void setMemoryBudget(std::size_t bytes);
    std::size_t memoryBudget() const { return budgetBytes_; }
    GpuMemory memory() const;  // as of the next frame
    // Returns the largest memory since setMemoryBudget(), including copies during growth.
    std::size_t peakMemory() const { return peakBytes_; }
    // Sets memory used outside the renderer that the budget includes.
    void setStagingBytes(std::size_t bytes) { stagingBytes_ = bytes; }

    // Sets the quads of these mesh sections for the next frame; `mesh` has none of others. Returns false if
    // there is no room within the budget: the mesh sections are not shown then.
    bool setChunk(world::ChunkPos pos, const mesh::ChunkMesh& mesh,
                  const mesh::MeshSectionSet& meshSections = mesh::kAllMeshSections);
    // Does the same for the whole chunk without the quads: before the next frame a shader writes them into
    // quadBuffers(), to the ranges of meshSectionsOf().
    bool reserveChunk(world::ChunkPos pos, std::span<const mesh::MeshSection> meshes);
    std::span<const mesh::MeshSection> meshSectionsOf(world::ChunkPos pos) const {
        return quads_.meshSectionsOf(pos);
    }
    gpu::ArenaBuffers quadBuffers() const { return quads_.buffers(); }  // until the next change
    // Return what frames with the current options need of chunks and tiles. When that changes, all of them
    // come again.
    bool readsQuads() const { return render::readsQuads(options()); }    // setChunk(), reserveChunk()
    bool readsBlocks() const { return render::readsBlocks(options()); }  // setBlocks()
    // Sets the blocks of a chunk or tile, not null, if frames need them. Returns false if there is no room
    // within the budget: it is not shown then.
    bool setBlocks(world::ChunkPos pos, world::ChunkPtr blocks);
    // Sets the light of a chunk of level 0, within `viewDistance` of setViewDistance(). Chunks without light
    // are drawn as under the open sky. Result: see LightStore.
    bool setLight(world::ChunkPos pos, const light::ChunkLight& light);
    // Does the same for the bricks that may differ from the last call.
    bool setLight(world::ChunkPos pos, const light::ChunkLight& light, const world::SectionSet& bricks);
    void removeChunk(world::ChunkPos pos);
    // Sets whether tinted faces take a tint. All tiles are removed; the tint is neutral where no tile is set.
    // If the shaders cannot be compiled it fails and changes nothing.
    base::Result<void> useTint(bool isUsed);
    bool hasTint() const { return tints_.isUsed(); }
    // Sets the tint of a tile for which tintClipmap().isTile(), after useTint(true).
    void setTint(world::ChunkPos tile, const world::TintTile& colors) { tints_.set(tile, colors); }
    const Clipmap& tintClipmap() const { return tints_.clipmap(); }
    // Sets whether the land up to the horizon affects light (land_map.h). All its tiles are removed. Fails
    // like useTint().
    base::Result<void> useLand(bool isUsed);
    bool hasLand() const { return land_.isUsed(); }
    // Returns whether frames with the current options need the land's tiles.
    bool readsLand() const { return land_.isUsed() && render::readsLand(options()); }
    // These set the surface of a tile of the clipmap, and the view distance in blocks, after useLand(true).
    void setLand(world::ChunkPos tile, const world::LandTile& land) { land_.map().set(tile, land); }
    void setLandReach(double blocks) { land_.map().setReach(blocks); }
    const Clipmap& landClipmap() const { return land_.map().clipmap(); }
    // Makes the next frame compute all levels that changed, whatever the time; other frames compute at most
    // one.
    void completeLand() { completesLand_ = true; }
    // Shows or hides a chunk. A hidden chunk keeps its quads and its light. Chunks are shown by default. May
    // come before the chunk is set; removeChunk() resets it.
    void setShown(world::ChunkPos pos, bool isShown);
    // Allocates light for a view distance; light set before is removed.
    void setViewDistance(int chunks);
    // Removes all chunks and frees their memory except for the initial buffers.
    void clearChunks();

    // Draws into the renderer's own image.
    void draw(const FrameInput& input);

    base::Image readImage() const { return gpu::readPixels(*frame_.output); }  // waits for the GPU
    void presentToWindow(glm::ivec2 windowSize) const;

    // Returns the statistics of the newest frame that the GPU has finished.
    FrameStatistics statistics() {
        return statisticsOf(cull_.counts(), frame_.shadowMap ? frame_.shadowMap->drawnTriangles() : 0);
    }
    const std::vector<gpu::GpuTiming>& passTimes() const { return timer_.results(); }
    // Returns the number of triangles that one shadow map for this frame would draw.
    std::size_t shadowTriangles(const FrameInput& input) const;
    std::size_t quadBytes() const { return quads_.usedBytes(); }
    std::uint64_t uploadedQuadBytes() const { return quads_.uploadedBytes(); }  // since the beginning
    const world::TopColors& topColors() const { return topColors_; }            // of the textures in use
    std::size_t lightBytes() const { return light_.usedBytes(); }
    std::size_t chunkCount() const { return std::max(light_.chunkCount(), quads_.chunks().size()); }
    glm::ivec2 size() const { return frame_.spec.outputSize; }
    const Frame& frame() const { return frame_; }  // for tests and documents

  private:
    glm::ivec2 drawnSize() const { return frame_.spec.size; }
    // Rebuilds the frame and replaces the old one. If it fails, the old one stays.
    base::Result<void> rebuild(const FrameSpec& spec);
    QuadFeatures features() const { return {resources_.hasFaceSampling(), tints_.isUsed(), land_.isUsed()}; }
    FrameContext prepare(const FrameInput& input);
    void writeUniforms(const FrameInput& input, const ViewMatrices& view);
    CullInput cullInput(const FrameInput& input, const ViewMatrices& view);
    bool hasShadows(const FrameInput& input) const;
    void forgetShadows() {
        if (frame_.shadowMap) frame_.shadowMap->invalidate();
    }
    void showQuads(world::ChunkPos pos, const mesh::MeshSectionSet& changed);
    bool setLitQuads(const CornerLitChunks::Change& change);
    void readWritten(world::ChunkPos pos);
    void lightCorners(int maxChunks);
    base::Result<void> useCornerLight(bool isUsed);
    void makeRays(bool isUsed);
    bool setQuads(world::ChunkPos pos, const mesh::ChunkMesh& mesh, const mesh::MeshSectionSet& meshSections);
    using ChunkMeshes = std::vector<std::pair<world::ChunkPos, mesh::ChunkMesh>>;
    bool setAllQuads(bool isLit, const ChunkMeshes& meshes);
    void shareBudget();
    void notePeak();

    std::unique_ptr<Programs> programs_;
    Frame frame_;
    QuadStore quads_{{.arenaQuads = 1}};  // until clearChunks()
    MeshSectionTable meshSections_;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> hidden_;  // chunks that are not shown
    LightStore light_;
    RayStore rays_;
    CornerLitChunks cornerLit_;  // has meshes while the quads have light
    std::unordered_set<world::ChunkPos, world::ChunkPosHash>
        unread_;  // chunks whose quads a shader writes, to be lit
    QuadResources resources_;
    TintTextures tints_;
    LandTextures land_;
    world::TopColors topColors_;
    bool completesLand_ = false;
    gpu::MappedRing ring_;
    gpu::GpuTimer timer_;
    gpu::Pipeline pipeline_;

    CullPass cull_;
    FigurePass figures_;
    gpu::VertexArray fullscreen_;
    SkyNoise noise_;
    SkyTexture sky_;

    const gpu::ShaderLoader* shaders_ = nullptr;
    std::shared_ptr<const world::BlockRegistry> blocks_;
    gpu::DeviceInfo device_;
    TextureLimits textureLimits_;
    QuadStoreSizes quadSizes_;
    world::Heights heights_;
    world::AirLevels airLevels_;
    int viewDistance_ = 0;  // chunks
    std::size_t budgetBytes_ = SIZE_MAX, stagingBytes_ = 0, peakBytes_ = 0;
};

}  // namespace terrane::render
