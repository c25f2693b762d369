#include "apps/terrane/shaders.h"

#include "terrane/base/embedded.h"

namespace terrane::embedded {
std::span<const base::EmbeddedFile> shaders();
}  // namespace terrane::embedded

namespace terrane::app {

gpu::ShaderLoader makeShaderLoader(const std::string& shaderRoot) {
    return gpu::ShaderLoader(embedded::shaders(), shaderRoot);
}

}  // namespace terrane::app
