// Replaces sound_player.cpp in a build without OpenAL.
#include "terrane/sound/sound_player.h"

namespace terrane::sound {

struct SoundPlayer::Device {};

base::Result<SoundPlayer> SoundPlayer::create(const SoundSet&, SoundOutput) {
    return base::fail(base::ErrorCode::Unsupported, "this build has no sounds");
}

SoundPlayer::SoundPlayer(std::unique_ptr<Device> device) : device_(std::move(device)) {}
SoundPlayer::SoundPlayer(SoundPlayer&&) noexcept = default;
SoundPlayer& SoundPlayer::operator=(SoundPlayer&&) noexcept = default;
SoundPlayer::~SoundPlayer() = default;

void SoundPlayer::setVolume(float) {}
void SoundPlayer::setListener(const glm::dvec3&, float, float) {}
void SoundPlayer::play(const SoundCue&) {}
void SoundPlayer::setLoop(const SoundCue&) {}
void SoundPlayer::update(double) {}
void SoundPlayer::stop() {}
int SoundPlayer::playing() const {
    return 0;
}
std::vector<float> SoundPlayer::render(std::size_t frames) {
    return std::vector<float>(2 * frames);
}

}  // namespace terrane::sound
