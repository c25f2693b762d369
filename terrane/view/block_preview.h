// Lit images of single blocks, for the selected block and the slots of containers. Each image is drawn once
// and cached: 83 KB a block type, 16 MB for all, and at most 11 MB of textures. It is used on the thread of
// the OpenGL context.
#pragma once

#include <map>

#include "terrane/base/image.h"
#include "terrane/gpu/texture.h"
#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/render/frame/renderer.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::view {

class BlockPreview {
  public:
    static constexpr int kSize = 144;  // pixels
    static render::RenderOptions options();

    // Creates the renderer of the images. `shaders` and `blocks` outlive this.
    static base::Result<BlockPreview> create(const gpu::ShaderLoader& shaders,
                                             const world::BlockRegistry& blocks,
                                             const render::TextureSource& textures,
                                             const gpu::DeviceInfo& device);
    base::Result<void> setTextures(const render::TextureSource& textures);
    base::Result<void> reloadShaders();  // all images are drawn again on request

    // Returns the OpenGL texture with the block's image, transparent around the block; the first row is the
    // top. The result is 0 if the image does not exist yet and the limit of beginFrame() is reached: it is
    // drawn in a later frame.
    unsigned image(world::BlockId block);
    // Sets how many images may be drawn until the next call, at some milliseconds each.
    void beginFrame(int images) { leftInFrame_ = images; }

  private:
    BlockPreview(const world::BlockRegistry& blocks, render::Renderer renderer)
        : blocks_(&blocks), renderer_(std::move(renderer)) {}
    base::Image drawn(const mesh::ChunkMesh& mesh);
    gpu::Texture2D draw(world::BlockId block);

    const world::BlockRegistry* blocks_;
    render::Renderer renderer_;
    std::map<world::BlockId, gpu::Texture2D> images_;
    base::Image sky_;  // without a block
    int leftInFrame_ = 0;
};

}  // namespace terrane::view
