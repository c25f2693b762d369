// The textures and shaders that are compiled into the program, for tests that draw.
#pragma once

#include <string>
#include <string_view>

#include "terrane/base/files.h"
#include "terrane/content/built_in.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/render/frame/render_options.h"
#include "terrane/render/quads/block_textures.h"
#include "tests/world/content_blocks.h"

namespace terrane::embedded {
std::span<const base::EmbeddedFile> shaders();
}  // namespace terrane::embedded

namespace terrane::render {

inline base::Result<base::Image> contentTexture(std::string_view name) {
    return content::builtInTextures()(name);
}

inline const gpu::ShaderLoader& contentShaders() {
    static const gpu::ShaderLoader loader = gpu::builtInShaders("");
    return loader;
}

// Only light, textures and blended faces, for images that show one feature.
inline RenderOptions plainOptions(int samples) {
    RenderOptions options;
    options.msaaSamples = samples;
    options.shadows = ShadowReach::Off;
    options.depthOfField = options.godRays = options.bloom = options.clouds = false;
    options.water = Water::Plain;
    options.animation = options.msaaAlphaTest = false;
    return options;
}

}  // namespace terrane::render
