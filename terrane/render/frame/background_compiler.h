// Compiles the shaders of other options while frames go on. It draws a small image with them on a thread with
// its own OpenGL context; drivers cache compiled shaders (Mesa and NVIDIA do, on disk) and return them when
// the renderer compiles the same. If a driver has no cache, or EGL cannot draw without a window, the renderer
// compiles itself, and its frame waits.
#pragma once

#include <glm/vec2.hpp>
#include <memory>

#include "terrane/gpu/shader_loader.h"
#include "terrane/render/frame/render_options.h"
#include "terrane/render/quads/block_textures.h"

namespace terrane::render {

// Properties of the world that select shaders.
struct WorldFeatures {
    bool hasTint = false, hasLand = false;  // Renderer::useTint(), useLand()

    bool operator==(const WorldFeatures&) const = default;
};

class BackgroundCompiler {
  public:
    // Loader and registry outlive this; the other thread calls `textures`.
    BackgroundCompiler(const gpu::ShaderLoader& shaders, const world::BlockRegistry& blocks,
                       TextureSource textures);
    ~BackgroundCompiler();  // waits until the thread has finished its current image
    BackgroundCompiler(const BackgroundCompiler&) = delete;
    BackgroundCompiler& operator=(const BackgroundCompiler&) = delete;

    // Call this after the renderer has other textures: textures of several sizes need other shaders.
    void setTextures(TextureSource textures);
    // Returns whether a renderer of such a world and this size (pixels) can take these options without
    // compiling. If not, they are compiled next, replacing other waiting ones: call again before each frame
    // until it is true.
    [[nodiscard]] bool isReady(glm::ivec2 size, const RenderOptions& options, const WorldFeatures& features);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace terrane::render
