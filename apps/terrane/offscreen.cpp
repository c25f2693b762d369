#include "apps/terrane/offscreen.h"

#include "apps/terrane/content.h"
#include "apps/terrane/resource_pack.h"

namespace terrane::app {

base::Result<std::unique_ptr<Offscreen>> Offscreen::create(const WorldOptions& world, const SaveOptions& save,
                                                           const GraphicsOptions& graphics,
                                                           store::WorldAccess access) {
    auto session = WorldSession::create(world, save, access);
    if (!session) return tl::unexpected(session.error());
    auto textures = loadTextures(graphics.resourcePack, (*session)->blocks);
    if (!textures) return tl::unexpected(textures.error());
    auto context = gpu::HeadlessContext::create({.debug = graphics.debugGl});
    if (!context) return tl::unexpected(context.error());

    std::unique_ptr<Offscreen> made(new Offscreen{std::move(*session),
                                                  std::move(*context),
                                                  makeShaderLoader(graphics.shaderRoot),
                                                  gpu::queryDevice(),
                                                  {}});
    auto renderer = render::Renderer::create(made->shaders, made->session->blocks, *textures, made->device);
    if (!renderer) return tl::unexpected(renderer.error());
    made->renderer = std::move(*renderer);
    const auto options = renderOptions(graphics.choices, made->device.software);
    if (auto done = made->renderer.configure(graphics.size, options); !done)
        return tl::unexpected(done.error());
    made->renderer.setViewDistance(graphics.viewDistance);
    made->session->pipeline->setMeshOptions(graphics.mesh);
    return made;
}

base::Result<void> Offscreen::finish() const {
    if (context.debugErrorCount() == 0) return {};
    return base::fail("the graphics driver reported errors, see above");
}

}  // namespace terrane::app
