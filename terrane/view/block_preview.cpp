#include "terrane/view/block_preview.h"

#include "terrane/mesh/chunk_mesher.h"

namespace terrane::view {
namespace {

constexpr std::uint32_t kQuads = 1024;  // of one block there are few
constexpr int kZ = 100;                 // where the block floats
constexpr render::Camera kCamera{{5.3, 5.3, kZ + 2.6}, 45, -25, 24};

mesh::ChunkMesh meshOf(world::BlockId block, const world::BlockRegistry& blocks) {
    world::Chunk chunk;
    chunk.setBlock(world::blockIndex(8, 8, kZ), block);
    return mesh::meshAlone(chunk, blocks);
}

}  // namespace

render::RenderOptions BlockPreview::options() {
    render::RenderOptions options = render::findPreset("low", true)->options;
    options.msaaSamples = 1;
    return options;
}

base::Result<BlockPreview> BlockPreview::create(const gpu::ShaderLoader& shaders,
                                                const world::BlockRegistry& blocks,
                                                const render::TextureSource& textures,
                                                const gpu::DeviceInfo& device) {
    auto renderer = render::Renderer::create(shaders, blocks, textures, device, {.firstQuads = kQuads});
    if (!renderer) return tl::unexpected(renderer.error());
    if (auto done = renderer->configure({kSize, kSize}, options()); !done)
        return tl::unexpected(done.error());
    renderer->setViewDistance(1);
    return BlockPreview(blocks, std::move(*renderer));
}

base::Result<void> BlockPreview::setTextures(const render::TextureSource& textures) {
    images_.clear();
    return renderer_.setTextures(*blocks_, textures);
}

base::Result<void> BlockPreview::reloadShaders() {
    images_.clear();
    return renderer_.reloadShaders();
}

gpu::Texture2D BlockPreview::draw(world::BlockId block) {
    renderer_.setChunk({0, 0}, meshOf(block, *blocks_));
    renderer_.draw({kCamera, world::environmentAt(0.4f), 1000.0f});
    const gpu::Texture2D& drawn = renderer_.ldrTexture();
    gpu::Texture2D image(drawn.size(), drawn.format(), 1, "image of a block");
    image.copyFrom(drawn);
    return image;
}

unsigned BlockPreview::image(world::BlockId block) {
    auto found = images_.find(block);
    if (found == images_.end()) {
        if (drawnInFrame_ == kImagesAFrame) return 0;
        ++drawnInFrame_;
        found = images_.emplace(block, draw(block)).first;
    }
    return found->second.id();
}

}  // namespace terrane::view
