#include "terrane/game/player_state.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "terrane/base/log.h"

namespace terrane::game {

std::string textOf(const world::Pose& pose) {
    const glm::dvec3& p = pose.position;
    return fmt::format("{} {} {} {} {}", p.x, p.y, p.z, pose.yaw, pose.pitch);
}

std::optional<world::Pose> parsePose(const std::string& text) {
    std::istringstream in(text);
    world::Pose pose;
    in >> pose.position.x >> pose.position.y >> pose.position.z >> pose.yaw >> pose.pitch;
    const bool isGood = !in.fail() && (in >> std::ws).eof() && std::isfinite(pose.yaw) &&
                        std::abs(pose.pitch) <= 90 && std::isfinite(pose.position.z) &&
                        std::abs(pose.position.x) < 0x1p31 && std::abs(pose.position.y) < 0x1p31 &&
                        world::isInWorld(world::chunkOf(pose.position));
    return isGood ? std::optional(pose) : std::nullopt;
}

namespace {

// Names of metadata. The pose is that of the player's camera.
constexpr std::string_view kPose = "camera", kTime = "time", kHotbar = "hotbar";
constexpr std::string_view kFormerHand = "hand";  // one block's name, before there was a hotbar
constexpr std::string_view kMovement = "movement", kResourcePack = "resource_pack";

}  // namespace

SavedPlayer loadPlayer(store::ReadableStore& store) {
    const auto pose = store.metadata(kPose), time = store.metadata(kTime);
    SavedPlayer player;
    player.hotbar = store.metadata(kHotbar);
    if (const auto hand = store.metadata(kFormerHand); hand && !player.hotbar) player.hotbar = "0 " + *hand;
    player.movement = store.metadata(kMovement);
    player.resourcePack = store.metadata(kResourcePack);
    if (pose) player.pose = parsePose(*pose);
    if (pose && !player.pose)
        base::logWarning("the save's camera is not a position and direction in the world: {:?}", *pose);
    if (time) player.timeDay = parseTimeDay(*time);
    if (time && !player.timeDay)
        base::logWarning("the save's time of day is not a number from 0 to 1: {:?}", *time);
    return player;
}

void savePlayer(store::ChunkStore& store, const PlayerState& now, std::optional<PlayerState>& saved) {
    if (!saved || saved->pose != now.pose) store.setMetadata(kPose, textOf(now.pose));
    if (!saved || saved->timeDay != now.timeDay) saveTimeDay(store, now.timeDay);
    if (!saved || saved->hotbar != now.hotbar) store.setMetadata(kHotbar, now.hotbar);
    const auto put = [&](std::string_view name, const std::string PlayerState::*value) {
        // An empty value needs no row in a world that never had one.
        const bool isChanged =
            saved ? (*saved).*value != now.*value : !(now.*value).empty() || store.metadata(name);
        if (isChanged) store.setMetadata(name, now.*value);
    };
    put(kMovement, &PlayerState::movement);
    put(kResourcePack, &PlayerState::resourcePack);
    saved = now;
}

store::SaveNumber saveTimeDay(store::ChunkStore& store, double timeDay) {
    return store.setMetadata(kTime, fmt::format("{:.5f}", timeDay));
}

}  // namespace terrane::game
