#include "terrane/render/frame/programs.h"

#include <fmt/format.h>

namespace terrane::render {
namespace {

std::string pathOf(std::string_view name, std::string_view stage) {
    return fmt::format("terrane/render/{}.{}.glsl", name, stage);
}

std::string labelOf(std::string_view name) {
    return std::string(name.substr(name.rfind('/') + 1));
}

}  // namespace

template <class Compile>
base::Result<const gpu::Program*> Programs::find(std::string_view name, const gpu::ShaderDefines& defines,
                                                 Compile compile) {
    std::string key(name);
    for (const auto& [macro, value] : defines) key += fmt::format(" {}={}", macro, value);
    if (const auto found = programs_.find(key); found != programs_.end()) return found->second.get();
    auto compiled = TERRANE_TRY(compile());
    auto program = std::make_unique<gpu::Program>(std::move(compiled));
    return programs_.emplace(std::move(key), std::move(program)).first->second.get();
}

base::Result<const gpu::Program*> Programs::graphics(std::string_view vertexName,
                                                     std::string_view fragmentName,
                                                     const gpu::ShaderDefines& defines) {
    return find(fragmentName, defines, [&] {
        return gpu::Program::graphics(*shaders_, pathOf(vertexName, "vert"), pathOf(fragmentName, "frag"),
                                      defines, labelOf(fragmentName));
    });
}

base::Result<const gpu::Program*> Programs::fullscreen(std::string_view name,
                                                       const gpu::ShaderDefines& defines) {
    return graphics("frame/fullscreen", name, defines);
}

base::Result<const gpu::Program*> Programs::quads(std::string_view name, const gpu::ShaderDefines& defines) {
    return graphics("quads/quad", name, defines);
}

base::Result<const gpu::Program*> Programs::compute(std::string_view name,
                                                    const gpu::ShaderDefines& defines) {
    return find(name, defines, [&] {
        return gpu::Program::compute(*shaders_, pathOf(name, "comp"), defines, labelOf(name));
    });
}

}  // namespace terrane::render
