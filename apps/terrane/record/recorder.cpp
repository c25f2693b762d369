#include "apps/terrane/record/recorder.h"

#include <algorithm>

#include "apps/terrane/record/shot_figures.h"
#include "terrane/base/log.h"
#include "terrane/view/camera_pose.h"

namespace terrane::app {
namespace {

constexpr double kFadeSeconds = 0.5;

// The pipeline's clock follows the video, so that unloading does not depend on how long frames take.
stream::ChunkPipeline::Time timeOf(double seconds) {
    using Time = stream::ChunkPipeline::Time;
    return Time() + std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

float titleStrength(const TitleCue& title, double seconds) {
    const double fade = std::min(kFadeSeconds, title.seconds / 2);
    const double share = std::min(seconds, title.seconds - seconds) / fade;
    return static_cast<float>(std::clamp(share, 0.0, 1.0));
}

base::Result<void> Recorder::apply(const GraphicsOptions& graphics) {
    render::Renderer& renderer = parts_.world.renderer;
    stream::ChunkPipeline& pipeline = parts_.world.session->pipeline();
    const auto settings = render::settingsOf(graphics.choices, parts_.world.device.software);
    if (parts_.size != renderer.size() || settings.render != renderer.options()) {
        TERRANE_TRY(renderer.configure(parts_.size, settings.render));
    }
    pipeline.setMeshOptions(settings.mesh);
    parts_.world.view->setHorizon({settings.horizon, settings.detail});
    if (settings.viewDistance != viewDistance_) {
        viewDistance_ = settings.viewDistance;
        renderer.setViewDistance(viewDistance_);
        pipeline.resendLight();
    }
    return {};
}

// Warns once per shot if the camera is inside a block.
void Recorder::warnOfBlocks(const render::Camera& camera, const Shot& shot, double secondsInShot) {
    const game::Session& session = *parts_.world.session;
    const world::BlockId id = session.world().block(world::blockOf(camera.position));
    const world::BlockType& type = session.blocks().type(id);
    if (type.collision.empty() || warnedOf_ == &shot) return;
    warnedOf_ = &shot;
    base::logWarning("shot \"{}\": after {:.1f} s the camera is inside {}", shot.name, secondsInShot,
                     type.name);
}

base::Result<base::Image> Recorder::frame(double seconds) {
    const Shot& shot = shotAt(parts_.script, seconds);
    const double inShot = seconds - shot.start;
    const GraphicsOptions& graphics = optionsAt(shot, inShot);
    TERRANE_TRY(apply(graphics));
    const view::PathPoint point = shot.path.at(inShot);
    game::Session& session = *parts_.world.session;
    // Load the view first: an edit in it then updates only the chunks that it affects.
    view::loadAll(session, *parts_.world.view, point.camera, viewDistance_, timeOf(seconds));
    edits_.advanceTo(seconds, session);
    view::loadAll(session, *parts_.world.view, point.camera, viewDistance_, timeOf(seconds));

    warnOfBlocks(point.camera, shot, inShot);

    const std::vector<world::Figure> figures = figuresAt(shot, inShot);
    render::FrameInput input;
    input.figures = figures;
    input.camera = point.camera;
    input.environment = world::environmentAt(point.timeDay);
    input.fogDistance = view::fogDistance(parts_.world.view->sightDistance());
    input.timeSeconds = static_cast<float>(seconds);
    input.view = graphics.view;
    input.waterAbove = game::waterAbove(session, point.camera.position);
    parts_.world.renderer.draw(input);
    base::Image image = parts_.world.renderer.readImage();
    for (const TitleCue& title : shot.titles) {
        const float strength = titleStrength(title, inShot - title.time);
        if (strength > 0) parts_.titles.paint(image, title.text, title.isLarge, strength);
    }
    return image;
}

}  // namespace terrane::app
