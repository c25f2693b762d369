#include "terrane/sound/sound_player.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include "terrane/world/pose.h"

namespace terrane::sound {

namespace {

namespace fs = std::filesystem;

bool isSet(const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value;
}

bool hasServer() {
    std::error_code ignored;
    if (!isSet("XDG_RUNTIME_DIR")) return false;
    const fs::path folder = std::getenv("XDG_RUNTIME_DIR");
    return fs::exists(folder / "pulse" / "native", ignored) || fs::exists(folder / "pipewire-0", ignored);
}

// pcmC0D0p: device 0 of card 0, playback.
bool isPlayback(const fs::path& file) {
    const std::string name = file.filename().string();
    return name.starts_with("pcm") && name.ends_with('p');
}

}  // namespace

bool hasSoundCard(const fs::path& devices) {
#ifdef _WIN32
    return true;  // it has no such folder, and OpenAL finds out without messages
#endif
    if (isSet("ALSOFT_DRIVERS") || isSet("PULSE_SERVER") || hasServer()) return true;
    std::error_code error;
    for (fs::directory_iterator file(devices, error), end; !error && file != end; file.increment(error))
        if (isPlayback(file->path())) return true;
    return false;
}

namespace {

// The number 0 means "no buffer" and "no source" in OpenAL.
constexpr ALuint kNone = 0;

struct LoopbackFunctions {
    LPALCLOOPBACKOPENDEVICESOFT open = nullptr;
    LPALCRENDERSAMPLESSOFT render = nullptr;
};

template <class Function>
Function alcFunction(const char* name) {
    return reinterpret_cast<Function>(alcGetProcAddress(nullptr, name));
}

LoopbackFunctions loopbackFunctions() {
    if (alcIsExtensionPresent(nullptr, "ALC_SOFT_loopback") != ALC_TRUE) return {};
    return {alcFunction<LPALCLOOPBACKOPENDEVICESOFT>("alcLoopbackOpenDeviceSOFT"),
            alcFunction<LPALCRENDERSAMPLESSOFT>("alcRenderSamplesSOFT")};
}

// The volume of a sound at a distance, as in AL_INVERSE_DISTANCE_CLAMPED.
double gainAt(double distance) {
    return kFullVolumeDistance / std::max(distance, kFullVolumeDistance);
}

}  // namespace

// Types of the members of Device, in a named namespace for unity builds.
namespace openal {

struct DeviceCloser {
    void operator()(ALCdevice* device) const { alcCloseDevice(device); }
};
struct ContextCloser {
    void operator()(ALCcontext* context) const {
        alcMakeContextCurrent(nullptr);
        alcDestroyContext(context);
    }
};

// The source of a one-shot or a loop, and its place in the world.
struct Source {
    ALuint id = 0;  // none
    std::optional<glm::dvec3> position;
    float volume = 0;
};

struct Loop {
    Source source;
    float target = 0;  // volume
    float rate = 0;    // of its change, per second
};

}  // namespace openal

using openal::ContextCloser, openal::DeviceCloser, openal::Loop, openal::Source;

namespace {

bool isPlaying(const Source& source) {
    ALint state = AL_STOPPED;
    alGetSourcei(source.id, AL_SOURCE_STATE, &state);
    return state == AL_PLAYING;
}

}  // namespace

struct SoundPlayer::Device {
    std::unique_ptr<ALCdevice, DeviceCloser> device;
    std::unique_ptr<ALCcontext, ContextCloser> context;
    LPALCRENDERSAMPLESSOFT renderSamples = nullptr;
    std::map<std::string, std::vector<ALuint>, std::less<>> buffers;
    std::array<Source, kMaxSources> sources;
    std::map<std::string, Loop, std::less<>> loops;
    glm::dvec3 ears{0};
    std::uint32_t random = 1;

    ~Device();
    base::Result<void> open(SoundOutput output);
    base::Result<void> addBuffers(const SoundSet& sounds);
    ALuint anyOf(const std::vector<ALuint>& variants);
    double loudness(const Source& source) const;
    Source* freeSource(double loudnessOfNew);
    void place(const Source& source) const;
};

SoundPlayer::Device::~Device() {
    if (!context) return;
    for (const Source& source : sources) alDeleteSources(1, &source.id);
    for (const auto& [name, loop] : loops) alDeleteSources(1, &loop.source.id);
    for (const auto& [name, variants] : buffers)
        alDeleteBuffers(static_cast<ALsizei>(variants.size()), variants.data());
}

base::Result<void> SoundPlayer::Device::open(SoundOutput output) {
    const std::array<ALCint, 7> inMemory = {ALC_FORMAT_CHANNELS_SOFT,
                                            ALC_STEREO_SOFT,
                                            ALC_FORMAT_TYPE_SOFT,
                                            ALC_FLOAT_SOFT,
                                            ALC_FREQUENCY,
                                            kMemoryRate,
                                            0};
    if (output == SoundOutput::Memory) {
        const LoopbackFunctions loopback = loopbackFunctions();
        if (!loopback.open || !loopback.render)
            return base::fail(base::ErrorCode::Unsupported, "OpenAL cannot write sounds into memory");
        device.reset(loopback.open(nullptr));
        renderSamples = loopback.render;
    } else if (hasSoundCard()) {
        device.reset(alcOpenDevice(nullptr));
    }
    if (!device) return base::fail(base::ErrorCode::NotFound, "the system has no audio device");
    context.reset(alcCreateContext(device.get(), output == SoundOutput::Memory ? inMemory.data() : nullptr));
    if (!context || alcMakeContextCurrent(context.get()) != ALC_TRUE)
        return base::fail("the audio device cannot be used");
    alDistanceModel(AL_INVERSE_DISTANCE_CLAMPED);
    for (Source& source : sources) alGenSources(1, &source.id);
    return alGetError() == AL_NO_ERROR ? base::Result<void>()
                                       : base::fail("the audio device has too few sources");
}

base::Result<void> SoundPlayer::Device::addBuffers(const SoundSet& sounds) {
    for (const auto& [name, variants] : sounds) {
        std::vector<ALuint>& ids = buffers[name];
        for (const Wave& wave : variants) {
            ids.push_back(kNone);
            alGenBuffers(1, &ids.back());
            alBufferData(ids.back(), AL_FORMAT_MONO16, wave.samples.data(),
                         static_cast<ALsizei>(wave.samples.size() * sizeof(std::int16_t)), wave.rate);
        }
    }
    return alGetError() == AL_NO_ERROR ? base::Result<void>()
                                       : base::fail(base::ErrorCode::OutOfResources, "no memory for sounds");
}

ALuint SoundPlayer::Device::anyOf(const std::vector<ALuint>& variants) {
    random = random * 1664525u + 1013904223u;
    return variants[(random >> 16) % variants.size()];
}

double SoundPlayer::Device::loudness(const Source& source) const {
    return double{source.volume} * (source.position ? gainAt(glm::distance(*source.position, ears)) : 1);
}

// A source that is not playing, else the quietest one if it is quieter than the new sound, else null.
Source* SoundPlayer::Device::freeSource(double loudnessOfNew) {
    for (Source& source : sources)
        if (!isPlaying(source)) return &source;
    Source* quietest = &sources[0];
    for (Source& source : sources)
        if (loudness(source) < loudness(*quietest)) quietest = &source;
    return loudness(*quietest) < loudnessOfNew ? quietest : nullptr;
}

// The ears stay at OpenAL's origin, since its floats are not exact far from it.
void SoundPlayer::Device::place(const Source& source) const {
    const glm::vec3 p = source.position ? glm::vec3(*source.position - ears) : glm::vec3(0);
    alSourcei(source.id, AL_SOURCE_RELATIVE, source.position ? AL_FALSE : AL_TRUE);
    alSource3f(source.id, AL_POSITION, p.x, p.y, p.z);
    alSourcef(source.id, AL_REFERENCE_DISTANCE, static_cast<float>(kFullVolumeDistance));
}

base::Result<SoundPlayer> SoundPlayer::create(const SoundSet& sounds, SoundOutput output) {
    auto device = std::make_unique<Device>();
    TERRANE_TRY(device->open(output));
    TERRANE_TRY(device->addBuffers(sounds));
    return SoundPlayer(std::move(device));
}

SoundPlayer::SoundPlayer(std::unique_ptr<Device> device) : device_(std::move(device)) {}
SoundPlayer::SoundPlayer(SoundPlayer&&) noexcept = default;
SoundPlayer& SoundPlayer::operator=(SoundPlayer&&) noexcept = default;
SoundPlayer::~SoundPlayer() = default;

void SoundPlayer::setVolume(float volume) {
    alListenerf(AL_GAIN, std::clamp(volume, 0.0f, 1.0f));
}

void SoundPlayer::setListener(const glm::dvec3& position, float yaw, float pitch) {
    device_->ears = position;
    const glm::vec3 ahead = world::lookDirection(yaw, pitch);
    const glm::vec3 up = glm::cross(world::rightDirection(yaw), ahead);
    const std::array<ALfloat, 6> orientation = {ahead.x, ahead.y, ahead.z, up.x, up.y, up.z};
    alListenerfv(AL_ORIENTATION, orientation.data());
    for (const Source& source : device_->sources) device_->place(source);
    for (const auto& [name, loop] : device_->loops) device_->place(loop.source);
}

void SoundPlayer::play(const SoundCue& cue) {
    const auto found = device_->buffers.find(cue.name);
    if (found == device_->buffers.end() || found->second.empty()) return;
    const Source wanted{kNone, cue.position, std::clamp(cue.volume, 0.0f, 1.0f)};
    const bool isNear = !cue.position || glm::distance(*cue.position, device_->ears) <= kHearingDistance;
    Source* source = isNear && wanted.volume > 0 ? device_->freeSource(device_->loudness(wanted)) : nullptr;
    if (!source) return;
    *source = {source->id, wanted.position, wanted.volume};
    alSourceStop(source->id);
    alSourcei(source->id, AL_BUFFER, static_cast<ALint>(device_->anyOf(found->second)));
    alSourcef(source->id, AL_GAIN, source->volume);
    alSourcef(source->id, AL_PITCH, std::clamp(cue.pitch, 0.25f, 4.0f));
    device_->place(*source);
    alSourcePlay(source->id);
}

void SoundPlayer::setLoop(const SoundCue& cue) {
    const auto found = device_->buffers.find(cue.name);
    if (found == device_->buffers.end() || found->second.empty()) return;
    auto loop = device_->loops.find(cue.name);
    if (loop == device_->loops.end()) {
        if (cue.volume <= 0) return;
        loop = device_->loops.emplace(cue.name, Loop()).first;
        alGenSources(1, &loop->second.source.id);
        alSourcei(loop->second.source.id, AL_BUFFER, static_cast<ALint>(found->second.front()));
        alSourcei(loop->second.source.id, AL_LOOPING, AL_TRUE);
    }
    Loop& changed = loop->second;
    const float target = std::clamp(cue.volume, 0.0f, 1.0f);
    if (target != changed.target)
        changed.rate = std::abs(target - changed.source.volume) / static_cast<float>(kFadeSeconds);
    changed.target = target;
    changed.source.position = cue.position;
    device_->place(changed.source);
}

void SoundPlayer::update(double seconds) {
    for (auto& [name, loop] : device_->loops) {
        const float step = loop.rate * static_cast<float>(seconds);
        float& volume = loop.source.volume;
        volume = loop.target > volume ? std::min(loop.target, volume + step)
                                      : std::max(loop.target, volume - step);
        alSourcef(loop.source.id, AL_GAIN, volume);
        const bool plays = isPlaying(loop.source);
        if (volume > 0 && !plays) alSourcePlay(loop.source.id);
        if (volume == 0.0f && plays) alSourcePause(loop.source.id);
    }
}

void SoundPlayer::stop() {
    for (const Source& source : device_->sources) alSourceStop(source.id);
    for (auto& [name, loop] : device_->loops) {
        loop.source.volume = loop.target = 0;
        alSourceStop(loop.source.id);
    }
}

int SoundPlayer::playing() const {
    return static_cast<int>(std::ranges::count_if(device_->sources, isPlaying));
}

std::vector<float> SoundPlayer::render(std::size_t frames) {
    std::vector<float> samples(2 * frames);
    if (device_->renderSamples)
        device_->renderSamples(device_->device.get(), samples.data(), static_cast<ALCsizei>(frames));
    return samples;
}

}  // namespace terrane::sound
