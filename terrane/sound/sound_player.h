// Plays sounds at places of the world, through OpenAL. Owns the device and all its objects. It is used on one
// thread, which may be another than the one that created it; one player at a time. No call waits for the
// device.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/sound/sound_set.h"

namespace terrane::sound {

// Returns whether the system may have a sound output: false if it surely has none, because opening a device
// would then make system libraries print errors. A sound card is a file in `devices`; a sound server has a
// socket in the user's runtime folder or is named by an environment variable, as are the drivers of OpenAL.
bool hasSoundCard(const std::filesystem::path& devices = "/dev/snd");

constexpr int kMaxSources = 24;            // sounds at once, loops not counted
constexpr double kHearingDistance = 48;    // blocks; farther sounds are not played
constexpr double kFullVolumeDistance = 2;  // blocks; from there on sounds get quieter
constexpr double kFadeSeconds = 1.5;       // of a loop, from one volume to another

enum class SoundOutput : std::uint8_t {
    Device,  // the system's speakers
    Memory,  // render(), for tests
};

struct SoundCue {
    std::string_view name;               // in the SoundSet; others are silent
    std::optional<glm::dvec3> position;  // in the world; none: in the player's head
    float volume = 1;                    // 0 to 1
    float pitch = 1;                     // 2: an octave higher
};

class SoundPlayer {
  public:
    static constexpr int kMemoryRate = 44100;  // samples a second of render()

    // Opens the output. Returns Unsupported in a build without OpenAL; NotFound if the system has nothing to
    // play on. May take seconds if the system's sound server does not answer.
    static base::Result<SoundPlayer> create(const SoundSet& sounds, SoundOutput output = SoundOutput::Device);
    SoundPlayer(SoundPlayer&&) noexcept;
    SoundPlayer& operator=(SoundPlayer&&) noexcept;
    ~SoundPlayer();

    void setVolume(float volume);  // of all; 0 to 1
    // Sets the position and direction of the ears in the world (world::Pose).
    void setListener(const glm::dvec3& position, float yaw, float pitch);

    // Plays one of the sound's variants. If all sources are busy the quietest one stops, if it is quieter.
    void play(const SoundCue& cue);
    // Starts or changes a looping sound; it reaches its volume within kFadeSeconds, and stops at 0.
    void setLoop(const SoundCue& cue);
    // Fades loops. It is called once a frame.
    void update(double seconds);
    // Stops all sounds at once.
    void stop();

    int playing() const;  // sounds that are heard now, loops not counted
    // Returns the next frames of SoundOutput::Memory: left, right, left…, −1 to 1.
    std::vector<float> render(std::size_t frames);

  private:
    struct Device;
    explicit SoundPlayer(std::unique_ptr<Device> device);

    std::unique_ptr<Device> device_;
};

}  // namespace terrane::sound
