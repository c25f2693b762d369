#include "terrane/view/recorder.h"

#include <algorithm>
#include <cmath>

#include "terrane/base/log.h"
#include "terrane/game/figure_motion.h"
#include "terrane/view/camera_path.h"
#include "terrane/world/character.h"

namespace terrane::view {

EditPlayer::EditPlayer(std::span<const Shot> shots) {
    for (const Shot& shot : shots)
        for (const EditCue& edit : shot.edits) edits_.push_back({&edit, shot.start + edit.time});
}

void EditPlayer::advanceTo(double seconds, game::Session& session) {
    for (Progress& progress : edits_) {
        const std::int64_t wanted = blocksDone(*progress.edit, seconds - progress.start);
        for (; progress.done < wanted; ++progress.done) {
            const world::BlockPos pos = progress.edit->box.blockAt(progress.done);
            session.pipeline().chunkAt(world::chunkOf(pos));
            session.edit({game::kNoPlayer, pos, world::SetBlock{progress.edit->block}, std::nullopt});
        }
    }
}

std::int64_t blocksDone(const EditCue& edit, double seconds) {
    if (seconds < -kTimeSlack) return 0;
    if (seconds + kTimeSlack >= edit.seconds) return edit.box.blockCount();
    const double share = (seconds + kTimeSlack) / edit.seconds;
    return static_cast<std::int64_t>(share * static_cast<double>(edit.box.blockCount()));
}

namespace {

using Motion = game::FigureMotion;

constexpr int kStepsPerSecond = 60,
              kStepsPerPose = 6;  // a server sends poses of near players ten times a second

Motion::Time momentOf(double seconds) {
    return Motion::Time() +
           std::chrono::duration_cast<Motion::Time::duration>(std::chrono::duration<double>(seconds));
}

world::Pose poseAt(const PlayerCue& player, double seconds) {
    const render::Camera eyes = player.path.at(seconds).camera;
    return {eyes.position + glm::dvec3(0, 0, world::kEyeHeight), eyes.yaw, eyes.pitch};
}

bool isBuilding(const Shot& shot, const PlayerCue& player, double seconds) {
    return std::ranges::any_of(shot.edits, [&](const EditCue& edit) {
        return edit.player == player.name && seconds >= edit.time &&
               seconds < edit.time + std::max(edit.seconds, Motion::kSwingSeconds);
    });
}

world::Figure figureAt(const Shot& shot, const PlayerCue& player, double secondsInShot) {
    Motion motion(poseAt(player, 0), momentOf(0), player.number);
    double swingEnd = 0;
    const int steps = static_cast<int>(std::max(secondsInShot, 0.0) * kStepsPerSecond + kTimeSlack);
    for (int step = 0; step < steps; ++step) {
        const double seconds = static_cast<double>(step) / kStepsPerSecond;
        // The motion reaches this pose when the next one arrives.
        if (step % kStepsPerPose == 0)
            motion.addPose(poseAt(player, seconds + static_cast<double>(kStepsPerPose) / kStepsPerSecond),
                           momentOf(seconds));
        if (seconds >= swingEnd && isBuilding(shot, player, seconds)) {
            motion.swing(momentOf(seconds));
            swingEnd = seconds + Motion::kSwingSeconds;
        }
        (void)motion.at(momentOf(seconds));
    }
    return motion.at(momentOf(secondsInShot));
}

}  // namespace

std::vector<world::Figure> figuresAt(const Shot& shot, double secondsInShot) {
    std::vector<world::Figure> figures;
    for (const PlayerCue& player : shot.players) figures.push_back(figureAt(shot, player, secondsInShot));
    return figures;
}

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

base::Result<void> Recorder::apply(const OptionsCue& graphics) {
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

// Warns once per shot if the camera sees through a block.
void Recorder::warnOfBlocks(const render::Camera& camera, const Shot& shot, double secondsInShot) {
    if (warnedOf_ == &shot) return;
    const auto block = blockAtCamera(*parts_.world.session, camera);
    if (!block) return;
    warnedOf_ = &shot;
    base::logWarning("shot \"{}\": after {:.1f} s the camera is {}", shot.name, secondsInShot, *block);
}

base::Result<base::Image> Recorder::frame(double seconds) {
    const Shot& shot = shotAt(parts_.shots, seconds);
    const double inShot = seconds - shot.start;
    const OptionsCue& graphics = optionsAt(shot, inShot);
    TERRANE_TRY(apply(graphics));
    const PathPoint point = shot.path.at(inShot);
    game::Session& session = *parts_.world.session;
    // Load the view first: an edit in it then updates only the chunks that it affects.
    loadAll(session, *parts_.world.view, point.camera, viewDistance_, timeOf(seconds));
    edits_.advanceTo(seconds, session);
    loadAll(session, *parts_.world.view, point.camera, viewDistance_, timeOf(seconds));

    warnOfBlocks(point.camera, shot, inShot);

    const std::vector<world::Figure> figures = figuresAt(shot, inShot);
    render::FrameInput input;
    input.figures = figures;
    input.camera = point.camera;
    input.environment = world::environmentAt(point.timeDay);
    input.fogDistance = fogDistance(parts_.world.view->visibleDistance());
    input.timeSeconds = static_cast<float>(seconds);
    input.view = graphics.view;
    input.waterAbove = game::waterAbove(session, point.camera.position);
    if (seenShot_ != &shot) eye_ = {};  // a cut
    input.exposure = eye_.look(session, input, render::aspectOf(parts_.size), seconds - seenSeconds_);
    seenShot_ = &shot;
    seenSeconds_ = seconds;
    parts_.world.renderer.draw(input);
    base::Image image = parts_.world.renderer.readImage();
    for (const TitleCue& title : shot.titles) {
        const float strength = titleStrength(title, inShot - title.time);
        if (strength > 0 && parts_.paintTitle) parts_.paintTitle(image, title, strength);
    }
    return image;
}

}  // namespace terrane::view
