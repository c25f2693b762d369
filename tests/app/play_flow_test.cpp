#include "apps/terrane/window/game/play_flow.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "apps/terrane/window/settings/settings_table.h"
#include "apps/terrane/window/title/title_background.h"
#include "terrane/store/overlay_store.h"

namespace terrane::app {
namespace {

PlaySettings settingsWith(const game::SavedPlayer& saved, const GivenOptions& given) {
    PlaySettings settings;
    settings.resourcePack = "default";
    takeFromWorld(settings, saved, given);
    return settings;
}

TEST(PlayFlow, AWorldBringsItsWayToMoveAndItsTextures) {
    game::SavedPlayer saved;
    EXPECT_EQ(settingsWith(saved, {}).movement, game::Movement::Walk);
    EXPECT_EQ(settingsWith(saved, {}).resourcePack, "default");
    for (const auto& [former, movement] : {std::pair("gravity", game::Movement::Walk),
                                           {"walls", game::Movement::Fly},
                                           {"medium", game::Movement::Noclip},
                                           {"fast", game::Movement::Noclip}}) {
        saved.movement = former;
        EXPECT_EQ(settingsWith(saved, {}).movement, movement) << "as an earlier version saved it";
    }
    saved.movement = "noclip";
    saved.resourcePack = "pack";
    EXPECT_EQ(settingsWith(saved, {}).movement, game::Movement::Noclip);
    EXPECT_EQ(settingsWith(saved, {}).resourcePack, "pack");
    saved.resourcePack = "";  // reset by the player
    EXPECT_EQ(settingsWith(saved, {}).resourcePack, "");
    // The command line takes precedence.
    EXPECT_EQ(settingsWith(saved, {.movement = true}).movement, game::Movement::Walk);
    EXPECT_EQ(settingsWith(saved, {.resourcePack = true}).resourcePack, "default");
    saved.movement = "teleport\n\x1b[31m";
    EXPECT_EQ(settingsWith(saved, {}).movement, game::Movement::Walk);
}

TEST(PlayFlow, SettingsKeepNeither) {
    PlaySettings settings;
    settings.movement = game::Movement::Noclip;
    settings.resourcePack = "pack";
    const SettingValues values = valuesOf(settings, true);
    EXPECT_FALSE(values.contains("movement"));
    EXPECT_FALSE(values.contains("resource-pack"));
    settings.keys.bind(Action::Jump, Key::X);
    settings.invertY = settings.reducedMotion = true;
    settings.textSize = 1.5f;
    const SettingValues changed = valuesOf(settings, true);
    EXPECT_EQ(changed.at("keys"), "jump=X");
    EXPECT_EQ(changed.at("invert-y"), "true");
    EXPECT_EQ(changed.at("reduced-motion"), "true");
    EXPECT_EQ(changed.at("text-size"), "1.50");
    EXPECT_FALSE(changed.contains("high-contrast"));
}

TEST(PlayFlow, MovementNamesLeadBack) {
    for (const auto& [name, movement] : movementNames()) {
        EXPECT_EQ(nameOf(movement), name);
        EXPECT_EQ(movementNamed(name), movement);
    }
    EXPECT_EQ(movementNamed(""), std::nullopt);
}

// The flight behind the title is slow and closed, and looks ahead.
TEST(TitleBackground, FliesInACircle) {
    const glm::dvec3 center(100, -50, 90);
    const world::Pose start = flightPose(center, 0);
    for (double seconds = 0; seconds < 700; seconds += 1) {
        const world::Pose now = flightPose(center, seconds), next = flightPose(center, seconds + 1);
        const glm::dvec3 step = next.position - now.position;
        EXPECT_LT(glm::length(step), 1.5);
        EXPECT_EQ(now.position.z, center.z);
        EXPECT_NEAR(glm::length(now.position - center), glm::length(start.position - center), 1e-9);
        EXPECT_GT(glm::dot(glm::normalize(step), glm::dvec3(world::lookDirection(now.yaw, 0))), 0.8);
    }
}

}  // namespace
}  // namespace terrane::app
