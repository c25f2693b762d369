#include "terrane/view/offscreen.h"

#include <utility>

#include "terrane/render/quads/draw_check.h"

namespace terrane::view {

base::Result<std::unique_ptr<Offscreen>> Offscreen::create(game::SessionParts parts,
                                                           const gen::GeneratorCatalogue& generators,
                                                           const world::TextureSource& textures,
                                                           const OffscreenSettings& settings) {
    auto context = TERRANE_TRY(gpu::HeadlessContext::create({.debug = settings.debugGl}));
    gpu::ShaderLoader shaders = gpu::builtInShaders(settings.shaderRoot);
    gpu::DeviceInfo device = render::checkedDevice(shaders);
    std::unique_ptr<Offscreen> made(new Offscreen{
        std::move(context), std::move(shaders), std::move(device), {}, {}, {}, {}, {}, textures});
    if (settings.usesGpu) {
        auto backEnds = TERRANE_TRY(useGpuBackEnds(parts, generators));
        made->backEnds = std::move(backEnds);
    }
    auto renderer = render::Renderer::create(made->shaders, *parts.blocks, textures, made->device);
    if (!renderer) return tl::unexpected(renderer.error());
    made->renderer = std::move(*renderer);
    made->renderer.setMemoryBudget(gpuMemoryBudget(made->device, settings.gpuMemory));
    made->graphics = render::settingsOf(settings.graphics, made->device.software);
    TERRANE_TRY(made->renderer.configure(settings.size, made->graphics.render));
    made->renderer.setViewDistance(made->graphics.viewDistance);
    made->session = std::make_unique<game::Session>(std::move(parts));
    made->session->pipeline().setMeshOptions(made->graphics.mesh);
    made->view.emplace(*made->session, made->renderer);
    made->view->setHorizon({made->graphics.horizon, made->graphics.detail});
    if (made->backEnds) {
        auto meshes = made->view->meshOnGpu(gpu::builtInShaders(""), settings.meshMilliseconds);
        if (!meshes) return tl::unexpected(meshes.error());
    }
    return made;
}

base::Result<void> Offscreen::finish() const {
    if (context.debugErrorCount() == 0) return {};
    return base::fail("the graphics driver reported errors, see above");
}

}  // namespace terrane::view
