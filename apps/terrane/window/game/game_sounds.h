// Plays the sounds of a game: player, blocks, wind and water. Used on the window's thread.
#pragma once

#include <future>
#include <optional>

#include "terrane/game/player.h"
#include "terrane/game/session.h"
#include "terrane/game/sounds.h"
#include "terrane/sound/sound_player.h"

namespace terrane::app {

class GameSounds {
  public:
    // Listens to the edits of `session`, which outlives this. A volume above 0 opens the device in the
    // background; without a device the game is silent.
    explicit GameSounds(game::Session& session);
    GameSounds(const GameSounds&) = delete;
    GameSounds& operator=(const GameSounds&) = delete;

    void setVolume(float volume);  // 0 to 1; 0 opens and plays nothing
    // Call once per frame. In a menu movement is silent, and wind and water fade out.
    void update(const game::Player& player, bool isInMenu, double seconds);
    void click();  // of a button

  private:
    using Opened = base::Result<sound::SoundPlayer>;

    void adoptPlayer();
    void onEdits(game::PlayerId player, std::span<const world::BlockEdit> edits);
    void playFoot(const game::FootEvent& event, const world::Character& character);
    void followAmbience(const glm::dvec3& ears, bool isInMenu, double seconds);

    game::Session& session_;
    std::future<Opened> opening_;
    std::optional<sound::SoundPlayer> player_;
    game::Footsteps footsteps_;
    float volume_ = 0;
    bool isAsked_ = false;      // a device was requested
    double untilAmbience_ = 0;  // seconds
    game::Subscription edited_;
};

}  // namespace terrane::app
