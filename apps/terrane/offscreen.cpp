#include "apps/terrane/offscreen.h"

#include <utility>

#include "terrane/content/resource_pack.h"
#include "terrane/io/open_session.h"

namespace terrane::app {

base::Result<std::unique_ptr<view::Offscreen>> openOffscreen(const OffscreenOptions& options) {
    const GraphicsOptions& graphics = options.graphics;
    const bool castsRays =
        render::settingsOf(graphics.choices, false).render.surfaces == render::SurfaceMethod::Rays;
    if (castsRays && graphics.view == render::View::Merging)
        return base::fail(base::ErrorCode::BadInput,
                          "--view merging cannot be used with --renderer rays, which draws no quads");
    io::WorldOptions world = options.world;
    auto opened = TERRANE_TRY(io::openSessionParts(world, options.save, options.access));
    const auto textures = TERRANE_TRY(
        content::loadTextures(graphics.resourcePack, *opened.parts.blocks, opened.content.textures));
    return view::Offscreen::create(std::move(opened.parts), opened.content.generators, textures,
                                   {.size = graphics.size,
                                    .graphics = graphics.choices,
                                    .gpuMemory = graphics.gpuMemory,
                                    .shaderRoot = graphics.shaderRoot,
                                    .debugGl = graphics.debugGl,
                                    .usesGpu = usesGpu(options.backend),
                                    .meshMilliseconds = options.meshMilliseconds});
}

}  // namespace terrane::app
