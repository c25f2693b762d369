// The shader programs of the passes; each is compiled on the first request and then cached. It is used on the
// context's thread.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "terrane/base/result.h"
#include "terrane/gpu/program.h"

namespace terrane::render {

class Programs {
  public:
    // The loader outlives this.
    explicit Programs(const gpu::ShaderLoader& shaders) : shaders_(&shaders) {}

    // Returns a program, compiled if needed. Names are paths below terrane/render without ".frag.glsl":
    // "effects/god_rays". The last part is the program's label. The program lives as long as this.
    base::Result<const gpu::Program*> fullscreen(std::string_view name,
                                                 const gpu::ShaderDefines& defines = {});
    // Returns a program that draws quads, with quad.vert.glsl.
    base::Result<const gpu::Program*> quads(std::string_view name, const gpu::ShaderDefines& defines);
    base::Result<const gpu::Program*> graphics(std::string_view vertexName, std::string_view fragmentName,
                                               const gpu::ShaderDefines& defines);
    base::Result<const gpu::Program*> compute(std::string_view name, const gpu::ShaderDefines& defines = {});

  private:
    template <class Compile>
    base::Result<const gpu::Program*> find(std::string_view name, const gpu::ShaderDefines& defines,
                                           Compile compile);

    const gpu::ShaderLoader* shaders_;
    std::map<std::string, std::unique_ptr<gpu::Program>> programs_;  // by name and defines
};

}  // namespace terrane::render
