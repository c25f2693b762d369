#include "apps/terrane/window/game/world_on_screen.h"

#include <epoxy/gl.h>

#include "apps/terrane/back_ends.h"
#include "terrane/content/resource_pack.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/view/gpu_back_ends.h"

namespace terrane::app {

// OpenGL keeps a program in use until another one is used, and its name could then be mistaken for a live
// one.
WorldOnScreen::~WorldOnScreen() {
    glUseProgram(0);
}

base::Result<std::unique_ptr<WorldOnScreen>> WorldOnScreen::create(io::OpenedWorld world,
                                                                   const ScreenOptions& options) {
    std::unique_ptr<WorldOnScreen> made(new WorldOnScreen);
    made->content_ = std::move(world.content);
    game::SessionParts& parts = world.parts;
    auto textures =
        TERRANE_TRY(content::loadTextures(options.resourcePack, *parts.blocks, made->content_.textures));
    auto renderer =
        TERRANE_TRY(render::Renderer::create(*options.shaders, *parts.blocks, textures, options.device));
    renderer.setMemoryBudget(view::gpuMemoryBudget(options.device, options.gpuMemory));
    made->renderer_ = std::make_unique<render::Renderer>(std::move(renderer));
    auto preview =
        TERRANE_TRY(view::BlockPreview::create(*options.shaders, *parts.blocks, textures, options.device));
    made->preview_ = std::make_unique<view::BlockPreview>(std::move(preview));
    if (usesGpu(options.backend)) {
        auto backEnds = TERRANE_TRY(view::useGpuBackEnds(parts, made->content_.generators));
        made->backEnds_ = std::move(backEnds);
    }
    made->session_ = std::make_unique<game::Session>(std::move(parts));
    made->compiler_ =
        std::make_unique<render::BackgroundCompiler>(*options.shaders, made->session_->blocks(), textures);
    made->view_ = std::make_unique<view::WorldView>(*made->session_, *made->renderer_);
    if (!made->backEnds_) return made;
    const auto meshes = made->view_->meshOnGpu(gpu::builtInShaders(""), view::WorldView::kFrameMilliseconds);
    if (!meshes) return tl::unexpected(meshes.error());
    return made;
}

}  // namespace terrane::app
