#include "terrane/render/frame/shader_variants.h"

#include <fmt/format.h>

#include <algorithm>

namespace terrane::render {

gpu::ShaderDefines defined(std::initializer_list<std::pair<const char*, int>> values) {
    gpu::ShaderDefines defines;
    for (const auto& [name, value] : values) defines.emplace_back(name, std::to_string(value));
    return defines;
}

ShaderVariants::ShaderVariants(const gpu::ShaderLoader& shaders, std::string vertexName,
                               std::string fragmentName, std::string label)
    : shaders_(&shaders),
      vertexName_(std::move(vertexName)),
      fragmentName_(std::move(fragmentName)),
      label_(std::move(label)) {}

base::Result<void> ShaderVariants::select(const gpu::ShaderDefines& defines) {
    const auto found = std::ranges::find(
        variants_, defines, [](const auto& variant) -> const auto& { return variant.first; });
    if (found != variants_.end()) {
        selected_ = static_cast<std::size_t>(found - variants_.begin());
        return {};
    }
    auto program =
        TERRANE_TRY(gpu::Program::graphics(*shaders_, vertexName_, fragmentName_, defines, label_));
    selected_ = variants_.size();
    variants_.emplace_back(defines, std::move(program));
    return {};
}

ShaderVariants quadShaders(const gpu::ShaderLoader& shaders, std::string_view name, std::string label) {
    return {shaders, "terrane/render/quads/quad.vert.glsl", fmt::format("terrane/render/{}.frag.glsl", name),
            std::move(label)};
}

}  // namespace terrane::render
