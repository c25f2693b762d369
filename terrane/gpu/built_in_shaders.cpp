#include "terrane/gpu/built_in_shaders.h"

#include "terrane/base/embedded.h"

namespace terrane::embedded {
std::span<const base::EmbeddedFile> shaders();
}  // namespace terrane::embedded

namespace terrane::gpu {

ShaderLoader builtInShaders(const std::string& shaderRoot) {
    return ShaderLoader(embedded::shaders(), shaderRoot);
}

}  // namespace terrane::gpu
