// A lit picture of one block, for the corner that shows what is in the hand. Drawn again only when the block
// changes. Used on the thread of the OpenGL context.
#pragma once

#include <optional>

#include "terrane/render/renderer.h"
#include "terrane/world/block_registry.h"

namespace terrane::app {

class BlockPreview {
  public:
    static constexpr int kSize = 144;  // pixels

    // `shaders` and `blocks` outlive this.
    static base::Result<BlockPreview> create(const gpu::ShaderLoader& shaders,
                                             const world::BlockRegistry& blocks,
                                             const gpu::DeviceInfo& device);

    // The OpenGL texture with the block's picture.
    unsigned picture(world::BlockId block);

  private:
    BlockPreview(const world::BlockRegistry& blocks, render::Renderer renderer)
        : blocks_(&blocks), renderer_(std::move(renderer)) {}

    const world::BlockRegistry* blocks_;
    render::Renderer renderer_;
    std::optional<world::BlockId> shown_;
};

}  // namespace terrane::app
