// Has the shaders of other options compiled while frames go on. A small image is drawn with them on a
// thread and in an OpenGL context of its own; drivers keep what they compiled (Mesa and NVIDIA do, on disk)
// and give it to the renderer when it asks for the same. Where a driver keeps nothing, or EGL cannot draw
// without a window, the renderer compiles itself, and its frame waits.
#pragma once

#include <glm/vec2.hpp>
#include <memory>

#include "terrane/gpu/shader_loader.h"
#include "terrane/render/block_textures.h"
#include "terrane/render/render_options.h"

namespace terrane::render {

// What a renderer was told to draw, as far as its shaders depend on it.
struct WorldFeatures {
    bool hasTint = false, hasLand = false;  // Renderer::useTint(), useLand()

    bool operator==(const WorldFeatures&) const = default;
};

class BackgroundCompiler {
  public:
    // Loader and registry outlive this; `textures` is called on the other thread.
    BackgroundCompiler(const gpu::ShaderLoader& shaders, const world::BlockRegistry& blocks,
                       TextureSource textures);
    ~BackgroundCompiler();  // waits until the thread ends the image it is at
    BackgroundCompiler(const BackgroundCompiler&) = delete;
    BackgroundCompiler& operator=(const BackgroundCompiler&) = delete;

    // Whether a renderer of such a world and this size (pixels) can take these options without compiling. If
    // not, they come next, in place of others that wait: ask again before each frame until it is so.
    [[nodiscard]] bool isReady(glm::ivec2 size, const RenderOptions& options, const WorldFeatures& features);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace terrane::render
