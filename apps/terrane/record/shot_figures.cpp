#include "apps/terrane/record/shot_figures.h"

#include <algorithm>

#include "terrane/game/figure_motion.h"
#include "terrane/world/character.h"

namespace terrane::app {
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
            motion.told(poseAt(player, seconds + static_cast<double>(kStepsPerPose) / kStepsPerSecond),
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

}  // namespace terrane::app
