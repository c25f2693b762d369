// Draws the world as the camera sees it: sky, terrain, tone mapping. Owns the quads of the visible chunks and
// the render targets. Used on the thread of the current OpenGL context.
#pragma once

#include <glm/vec2.hpp>

#include "terrane/base/image.h"
#include "terrane/base/result.h"
#include "terrane/gpu/device_info.h"
#include "terrane/gpu/framebuffer.h"
#include "terrane/render/block_textures.h"
#include "terrane/render/fullscreen_pass.h"
#include "terrane/render/light_store.h"
#include "terrane/render/quad_store.h"
#include "terrane/render/terrain_pass.h"
#include "terrane/world/environment.h"

namespace terrane::render {

enum class View : std::uint8_t { Color, Normal, Depth, Aggregation };

struct FrameInput {
    Camera camera;
    world::Environment environment;
    float fogDistance = 256;  // blocks: from here on everything is sky
    float timeSeconds = 0;    // for animations
    View view = View::Color;
    bool coverCracks = true;  // between quads of different sizes
    LightSampling light = LightSampling::Classic;
};

struct FrameStatistics {
    std::size_t regions = 0, quads = 0, drawCommands = 0;
    std::size_t opaqueTriangles = 0, transparentTriangles = 0;  // of these, alpha-tested ones are opaque
};

class Renderer {
  public:
    static base::Result<Renderer> create(const gpu::ShaderLoader& shaders, const world::BlockRegistry& blocks,
                                         const TextureSource& textures, const gpu::DeviceInfo& device);

    // Size of the picture in pixels; samples a pixel 1, 2, 4 or 8. Fails where the driver has not that many.
    base::Result<void> resize(glm::ivec2 size, int samples);

    // The next frame shows the chunk so. False where the GPU has no room: it is not shown then.
    bool setChunk(world::ChunkPos pos, const mesh::ChunkMesh& mesh) { return quads_.set(pos, mesh); }
    // Chunks without light are drawn as under the open sky. `viewDistance` of setViewDistance is the farthest
    // that light is kept for. `bricks`: see LightStore.
    void setLight(world::ChunkPos pos, const light::ChunkLight& light, std::uint16_t bricks = 0xFFFF) {
        light_.set(pos, light, bricks);
    }
    void removeChunk(world::ChunkPos pos) {
        quads_.remove(pos);
        light_.remove(pos);
    }
    // Makes room for light; what was set is forgotten.
    void setViewDistance(int chunks) { light_ = LightStore(chunks); }

    // Draws into the renderer's own picture.
    void draw(const FrameInput& input);

    base::Image readImage() const { return gpu::readPixels(targets_.picture); }  // waits for the GPU
    void presentToWindow(glm::ivec2 windowSize) const;

    const FrameStatistics& statistics() const { return statistics_; }
    // What a shadow map for this frame would draw.
    std::size_t shadowTriangles(const FrameInput& input) const;
    std::size_t quadBytes() const { return quads_.usedBytes(); }
    std::size_t lightBytes() const { return light_.usedBytes(); }
    glm::ivec2 size() const { return targets_.size; }

  private:
    struct Targets {
        glm::ivec2 size{0};
        gpu::Texture2DMultisample sampledColor, sampledDepth;  // where a pixel has several samples
        gpu::Texture2D color, depth, pictureColor;             // depth: where it has one
        gpu::Framebuffer sampled, scene, picture;
        // What the world is drawn into.
        const gpu::Framebuffer& world() const { return sampled.id() != 0 ? sampled : scene; }
    };
    static base::Result<Targets> makeTargets(glm::ivec2 size, int samples);
    static base::Result<void> addSamples(Targets& targets, int samples);
    void reserveRing();
    void bindFrame(const FrameInput& input, const ViewMatrices& view);

    FullscreenPass sky_, final_;
    TerrainPass terrain_;
    QuadStore quads_;
    LightStore light_;
    gpu::MappedRing ring_;
    DrawList drawList_;
    Targets targets_;
    FrameStatistics statistics_;
    int maxSamples_ = 1, maxSize_ = 1;
    float crackGrowth_ = 0;  // pixels
};

}  // namespace terrane::render
