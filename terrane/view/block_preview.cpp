#include "terrane/view/block_preview.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <span>

#include "terrane/mesh/chunk_mesher.h"

namespace terrane::view {
namespace {

constexpr std::uint32_t kQuads = 1024;  // one block has few
constexpr int kTextureSide = 128;       // more pixels than a face has in the image
constexpr int kZ = 100;                 // height of the block
constexpr render::Camera kCamera{{5.3, 5.3, kZ + 2.6}, 45, -25, 24};

mesh::ChunkMesh meshOf(world::BlockId block, const world::BlockRegistry& blocks) {
    world::Chunk chunk;
    chunk.setBlock(world::blockIndex(8, 8, kZ), block);
    return mesh::meshAlone(chunk, blocks);
}

// Makes pixels transparent that show only the background.
void clearWhereEqual(base::Image& image, const base::Image& background) {
    for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
        const bool isEqual = std::equal(image.rgba.begin() + static_cast<std::ptrdiff_t>(at),
                                        image.rgba.begin() + static_cast<std::ptrdiff_t>(at) + 3,
                                        background.rgba.begin() + static_cast<std::ptrdiff_t>(at));
        image.rgba[at + 3] = isEqual ? 0 : 255;
    }
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
    auto renderer = TERRANE_TRY(
        render::Renderer::create(shaders, blocks, textures, device, {.firstQuads = kQuads}, kTextureSide));
    TERRANE_TRY(renderer.configure({kSize, kSize}, options()));
    renderer.setViewDistance(1);
    return BlockPreview(blocks, std::move(renderer));
}

base::Result<void> BlockPreview::setTextures(const render::TextureSource& textures) {
    images_.clear();
    return renderer_.setTextures(*blocks_, textures);
}

base::Result<void> BlockPreview::reloadShaders() {
    images_.clear();
    sky_ = {};
    return renderer_.reloadShaders();
}

// Waits for the GPU: some milliseconds, once a block type.
base::Image BlockPreview::drawn(const mesh::ChunkMesh& mesh) {
    renderer_.setChunk({0, 0}, mesh);
    renderer_.draw({kCamera, world::environmentAt(0.4f), 1000.0f});
    return renderer_.readImage();
}

gpu::Texture2D BlockPreview::draw(world::BlockId block) {
    if (sky_.rgba.empty()) sky_ = drawn(mesh::ChunkMesh());
    base::Image image = drawn(meshOf(block, *blocks_));
    clearWhereEqual(image, sky_);
    gpu::Texture2D texture({image.width, image.height}, GL_RGBA8, 1, "image of a block");
    texture.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(image.rgba)));
    return texture;
}

unsigned BlockPreview::image(world::BlockId block) {
    auto found = images_.find(block);
    if (found == images_.end()) {
        if (leftInFrame_ == 0) return 0;
        --leftInFrame_;
        found = images_.emplace(block, draw(block)).first;
    }
    return found->second.id();
}

}  // namespace terrane::view
