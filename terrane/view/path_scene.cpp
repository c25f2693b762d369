#include "terrane/view/path_scene.h"

#include <algorithm>
#include <utility>

#include "terrane/path/tracer.h"
#include "terrane/render/frame/tone.h"
#include "terrane/render/sky/sky_texture.h"
#include "terrane/stream/tile_pipeline.h"

namespace terrane::view {
namespace {

using world::ChunkPos;

std::vector<ChunkPos> shownTiles(const Offscreen& world, ChunkPos center) {
    std::vector<ChunkPos> shown;
    for (const auto& [pos, record] : world.session->tiles().table().records)
        if (record.isShown) shown.push_back(pos);
    if (shown.empty()) {
        // Without a horizon there are no records.
        const int reach = world.view->viewDistance();
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x) shown.push_back({center.x + x, center.y + y});
    }
    std::ranges::sort(shown, [](ChunkPos a, ChunkPos b) {
        return std::tuple(a.level, a.y, a.x) < std::tuple(b.level, b.y, b.x);
    });
    return shown;
}

}  // namespace

world::Chunk wholeChunk(game::Session& session, ChunkPos pos) {
    store::LoadedChunk saved = session.store().load(pos);
    world::Chunk chunk = saved.chunk ? std::move(*saved.chunk) : session.generators().generate(pos);
    if (pos.level > 0) stream::raiseDeepFloor(chunk, session.blocks());
    return chunk;
}

base::Result<std::unique_ptr<path::Scene>> makePathScene(Offscreen& world, const render::FrameInput& input) {
    game::Session& session = *world.session;
    path::SceneParts parts;
    parts.blocks = &session.blocks();
    parts.heights = session.world().heights();
    parts.center = render::cameraChunk(input.camera);
    parts.textures = TERRANE_TRY(path::loadTextures(session.blocks(), world.textures));
    const std::vector<ChunkPos> shown = shownTiles(world, parts.center);
    parts.tiles.resize(shown.size());
    TERRANE_TRY(base::parallelFor(session.jobs(), shown.size(), [&](std::size_t k) {
        parts.tiles[k] = {shown[k], std::make_shared<const world::Chunk>(wholeChunk(session, shown[k])),
                          session.generators().tint(shown[k])};
    }));
    const world::AirLevels levels = gen::airLevelsOf(session.store().identity().generator);
    const auto cameraZ = static_cast<float>(input.camera.position.z);
    parts.air.frame = render::airUniforms(input.environment, levels, cameraZ);
    parts.air.cameraZ = cameraZ;
    if (world.graphics.render.distanceFog) parts.air.fogDistance = input.fogDistance;
    parts.sky = path::skyOf(input.environment, parts.air.frame);
    auto scene = std::make_unique<path::Scene>(std::move(parts));
    scene->parts.air.daylight = path::openSky(*scene, input.camera.position);
    return scene;
}

path::Camera pathCameraOf(const render::FrameInput& input, glm::ivec2 size, const Lens& lens) {
    const render::ViewMatrices view = render::viewMatrices(input.camera, render::aspectOf(size));
    return {.position = input.camera.position,
            .ahead = view.ahead,
            .across = view.across,
            .up = view.up,
            .lensRadius = lens.radius,
            .focus = lens.focus,
            .isInWater = input.waterAbove > 0};
}

base::Image displayedImage(const path::Means& means, glm::vec3 exposure) {
    base::Image image{means.size.x, means.size.y, {}};
    for (const glm::vec3& radiance : means.radiance) {
        const glm::vec3 color = render::displayColor(exposure * radiance);
        for (int c = 0; c < 3; ++c) image.rgba.push_back(static_cast<std::uint8_t>(color[c] * 255.0f + 0.5f));
        image.rgba.push_back(255);
    }
    return image;
}

}  // namespace terrane::view
