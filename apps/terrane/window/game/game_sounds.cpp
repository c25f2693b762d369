#include "apps/terrane/window/game/game_sounds.h"

#include <fmt/format.h>

#include <chrono>
#include <glm/common.hpp>

#include "terrane/base/log.h"
#include "terrane/game/sounds.h"
#include "terrane/gen/generators/catalogue.h"

namespace terrane::app {
namespace {

constexpr double kAmbiencePause = 0.4;  // seconds
constexpr float kStepVolume = 0.6f, kWindVolume = 0.5f, kWaterVolume = 0.6f, kBlockVolume = 0.8f;

base::Result<sound::SoundPlayer> openPlayer() {
    auto sounds = TERRANE_TRY(sound::builtInSounds());
    return sound::SoundPlayer::create(sounds);
}

std::string nameOf(world::SoundMaterial material, std::string_view action) {
    return fmt::format("{}_{}", world::kSoundMaterialNames[static_cast<std::size_t>(material)], action);
}

}  // namespace

GameSounds::GameSounds(game::Session& session)
    : session_(session), edited_(session.events.edited.add([this](const game::BlocksEdited& event) {
          onEdits(event.player, event.edits);
      })) {}

// Perceived loudness doubles with about ten times the power; the square of the volume approximates that.
void GameSounds::setVolume(float volume) {
    volume_ = volume;
    if (player_) player_->setVolume(volume * volume);
    if (isAsked_ || volume <= 0) return;
    isAsked_ = true;
    opening_ = std::async(std::launch::async, openPlayer);
}

void GameSounds::adoptPlayer() {
    if (!opening_.valid() || opening_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    Opened opened = opening_.get();
    if (!opened) return base::logInfo("without sounds: {}", opened.error().message);
    player_.emplace(std::move(*opened));
    player_->setVolume(volume_ * volume_);
}

void GameSounds::update(const game::Player& player, bool isInMenu, double seconds) {
    adoptPlayer();
    if (!player_ || volume_ <= 0) return;
    const world::Pose& pose = player.pose();
    player_->setListener(pose.position, pose.yaw, pose.pitch);
    if (player.movement() != game::Movement::Walk) {
        footsteps_.reset();
    } else if (const auto event = footsteps_.advance(player.character())) {
        playFoot(*event, player.character());
    }
    followAmbience(pose.position, isInMenu, seconds);
    player_->update(seconds);
}

void GameSounds::click() {
    if (player_) player_->play({.name = "ui_click", .position = {}});
}

void GameSounds::onEdits(game::PlayerId player, std::span<const world::BlockEdit> edits) {
    if (!player_ || volume_ <= 0) return;
    using Kind = game::BlockSound::Kind;
    for (const game::BlockSound& sound :
         game::soundsOf(session_.blocks(), edits, player != game::kNoPlayer)) {
        const glm::dvec3 middle(sound.pos.x + 0.5, sound.pos.y + 0.5, sound.pos.z + 0.5);
        player_->play({.name = nameOf(sound.material, sound.kind == Kind::Break ? "break" : "place"),
                       .position = middle,
                       .volume = kBlockVolume});
    }
}

// Plays at the player's ears: feet are straight below, so their sounds come from no side.
void GameSounds::playFoot(const game::FootEvent& event, const world::Character& character) {
    using Kind = game::FootEvent::Kind;
    const world::World& world = session_.world();
    const world::BlockRegistry& blocks = session_.blocks();
    const world::BlockType& inside = blocks.type(world.block(world::blockOf(character.feet)));
    std::string name;
    if (event.kind == Kind::Splash || event.kind == Kind::Swim) {
        name = event.kind == Kind::Swim ? "water_swim" : "water_splash";
    } else if (inside.shape == world::Shape::Liquid) {
        name = "water_swim";  // wading
    } else if (event.kind == Kind::Climb) {
        name = nameOf(inside.sound, "step");
    } else {
        name = nameOf(blocks.type(game::groundUnder(world, blocks, character.feet)).sound, "step");
    }
    const float volume = event.kind == Kind::Land ? 2 * event.strength : event.strength;
    player_->play({.name = name, .position = {}, .volume = kStepVolume * volume});
}

void GameSounds::followAmbience(const glm::dvec3& ears, bool isInMenu, double seconds) {
    untilAmbience_ -= seconds;
    if (untilAmbience_ > 0) return;
    untilAmbience_ = kAmbiencePause;
    game::Ambience ambience = game::ambienceAt(session_.world(), session_.blocks(), ears,
                                               gen::seaLevelOf(session_.store().identity().generator));
    if (isInMenu) ambience.wind = ambience.water = 0;
    player_->setLoop({.name = "wind_loop", .position = {}, .volume = kWindVolume * ambience.wind});
    player_->setLoop(
        {.name = "water_loop", .position = ambience.waterAt, .volume = kWaterVolume * ambience.water});
}

}  // namespace terrane::app
