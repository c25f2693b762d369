// A session and the objects that draw it, created together and destroyed in the right order. Used on the
// thread of the OpenGL context.
#pragma once

#include <memory>
#include <string>

#include "apps/terrane/back_ends.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/io/open_session.h"
#include "terrane/render/frame/background_compiler.h"
#include "terrane/view/block_preview.h"
#include "terrane/view/gpu_back_ends.h"
#include "terrane/view/world_view.h"

namespace terrane::app {

struct ScreenOptions {
    const gpu::ShaderLoader* shaders = nullptr;  // outlives the world
    gpu::DeviceInfo device;
    std::optional<int> gpuMemory;  // MiB
    std::string resourcePack;      // folder; empty: none
    Backend backend = Backend::Auto;
};

class WorldOnScreen {
  public:
    [[nodiscard]] static base::Result<std::unique_ptr<WorldOnScreen>> create(io::OpenedWorld world,
                                                                             const ScreenOptions& options);

    ~WorldOnScreen();
    WorldOnScreen(const WorldOnScreen&) = delete;
    WorldOnScreen& operator=(const WorldOnScreen&) = delete;

    const pack::Content& content() const { return content_; }
    game::Session& session() { return *session_; }
    render::Renderer& renderer() { return *renderer_; }
    view::WorldView& view() { return *view_; }
    view::BlockPreview& preview() { return *preview_; }
    render::BackgroundCompiler& compiler() { return *compiler_; }

  private:
    WorldOnScreen() = default;

    pack::Content content_;
    std::unique_ptr<render::Renderer> renderer_;
    std::unique_ptr<view::BlockPreview> preview_;
    std::unique_ptr<view::GpuBackEnds> backEnds_;
    std::unique_ptr<game::Session> session_;
    std::unique_ptr<render::BackgroundCompiler> compiler_;
    std::unique_ptr<view::WorldView> view_;
};

}  // namespace terrane::app
