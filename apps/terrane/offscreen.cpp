#include "apps/terrane/offscreen.h"

#include "terrane/content/resource_pack.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/view/gpu_back_ends.h"

namespace terrane::app {

base::Result<std::unique_ptr<Offscreen>> Offscreen::create(const OffscreenOptions& options) {
    const GraphicsOptions& graphics = options.graphics;
    io::WorldOptions world = options.world;
    auto opened = TERRANE_TRY(io::openSessionParts(world, options.save, options.access));
    game::SessionParts& parts = opened.parts;
    auto textures =
        TERRANE_TRY(content::loadTextures(graphics.resourcePack, *parts.blocks, opened.content.textures));
    auto context = TERRANE_TRY(gpu::HeadlessContext::create({.debug = graphics.debugGl}));

    std::unique_ptr<Offscreen> made(new Offscreen{std::move(context),
                                                  gpu::builtInShaders(graphics.shaderRoot),
                                                  gpu::queryDevice(),
                                                  {},
                                                  {},
                                                  {},
                                                  {},
                                                  {}});
    auto backEnds = TERRANE_TRY(chooseBackEnds(parts, opened.content.generators, options.backend));
    made->backEnds = std::move(backEnds);
    auto renderer = render::Renderer::create(made->shaders, *parts.blocks, textures, made->device);
    if (!renderer) return tl::unexpected(renderer.error());
    made->renderer = std::move(*renderer);
    made->renderer.setMemoryBudget(view::gpuMemoryBudget(made->device, graphics.gpuMemory));
    made->graphics = render::settingsOf(graphics.choices, made->device.software);
    TERRANE_TRY(made->renderer.configure(graphics.size, made->graphics.render));
    made->renderer.setViewDistance(made->graphics.viewDistance);
    made->session = std::make_unique<game::Session>(std::move(parts));
    made->session->pipeline().setMeshOptions(made->graphics.mesh);
    made->view.emplace(*made->session, made->renderer);
    made->view->setHorizon({made->graphics.horizon, made->graphics.detail});
    if (made->backEnds) {
        auto meshes = made->view->meshOnGpu(gpu::builtInShaders(""), options.meshMilliseconds);
        if (!meshes) return tl::unexpected(meshes.error());
    }
    return made;
}

base::Result<void> Offscreen::finish() const {
    if (context.debugErrorCount() == 0) return {};
    return base::fail("the graphics driver reported errors, see above");
}

}  // namespace terrane::app
