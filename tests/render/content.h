// The textures and shaders that are compiled into the program, for tests that draw.
#pragma once

#include <string>
#include <string_view>

#include "terrane/base/embedded.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/render/block_textures.h"
#include "tests/world/content_blocks.h"

namespace terrane::embedded {
std::span<const base::EmbeddedFile> content();
std::span<const base::EmbeddedFile> shaders();
}  // namespace terrane::embedded

namespace terrane::render {

inline base::Result<base::Image> contentTexture(std::string_view name) {
    const std::string path = "textures/" + std::string(name) + ".png";
    for (const base::EmbeddedFile& file : embedded::content()) {
        if (file.path == path) return base::decodePng(file.data, path);
    }
    return base::fail("{}: not in the content", path);
}

inline const gpu::ShaderLoader& contentShaders() {
    static const gpu::ShaderLoader loader(embedded::shaders());
    return loader;
}

}  // namespace terrane::render
