// The variants of one shader pair for options, each compiled when it is first selected. Used by the passes on
// the context's thread.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "terrane/gpu/program.h"

namespace terrane::render {

gpu::ShaderDefines defined(std::initializer_list<std::pair<const char*, int>> values);

class ShaderVariants {
  public:
    ShaderVariants() = default;
    // The loader outlives this.
    ShaderVariants(const gpu::ShaderLoader& shaders, std::string vertexName, std::string fragmentName,
                   std::string label);

    // Makes use() use this variant. On failure the previous one stays.
    base::Result<void> select(const gpu::ShaderDefines& defines);
    void use() const { variants_[selected_].second.use(); }

    const std::string& label() const { return label_; }

  private:
    const gpu::ShaderLoader* shaders_ = nullptr;
    std::string vertexName_, fragmentName_, label_;
    std::vector<std::pair<gpu::ShaderDefines, gpu::Program>> variants_;
    std::size_t selected_ = 0;
};

// Variants of a pass over quads. The fragment shader is terrane/render/NAME.frag.glsl.
ShaderVariants quadShaders(const gpu::ShaderLoader& shaders, std::string_view name, std::string label);

}  // namespace terrane::render
