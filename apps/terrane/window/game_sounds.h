// The sounds of a game: what the player and blocks do, wind and water. Used on the window's thread.
#pragma once

#include <future>
#include <optional>

#include "terrane/game/footsteps.h"
#include "terrane/game/player.h"
#include "terrane/game/session.h"
#include "terrane/sound/sound_player.h"

namespace terrane::app {

class GameSounds {
  public:
    // Listens to the edits of `session`, which outlives this. The device is opened in the background once the
    // volume is above 0; where there is none the game is silent.
    explicit GameSounds(game::Session& session);
    ~GameSounds();
    GameSounds(const GameSounds&) = delete;
    GameSounds& operator=(const GameSounds&) = delete;

    void setVolume(float volume);  // 0 to 1; 0: nothing is opened or played
    // Once a frame. In a menu nothing moves, and wind and water fade.
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
    bool isAsked_ = false;      // whether a device was asked for
    double untilAmbience_ = 0;  // seconds
};

}  // namespace terrane::app
