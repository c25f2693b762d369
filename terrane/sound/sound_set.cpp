#include "terrane/sound/sound_set.h"

#include <optional>

#include "terrane/base/files.h"

namespace terrane::sound {

namespace {

constexpr std::size_t kHeader = 12, kChunkHead = 8;

// A number of `count` bytes, the lowest first.
std::uint32_t numberAt(std::string_view bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < count; ++k)
        value |= std::uint32_t{static_cast<unsigned char>(bytes[at + k])} << (8 * k);
    return value;
}

// The content of the first chunk of this kind; chunks have even lengths.
std::optional<std::string_view> findChunk(std::string_view bytes, std::string_view kind) {
    std::size_t at = kHeader;
    while (at + kChunkHead <= bytes.size()) {
        const std::size_t length = numberAt(bytes, at + 4, 4), begin = at + kChunkHead;
        if (length > bytes.size() - begin) return std::nullopt;
        if (bytes.substr(at, 4) == kind) return bytes.substr(begin, length);
        at = begin + length + length % 2;
    }
    return std::nullopt;
}

}  // namespace

base::Result<Wave> parseWave(std::string_view bytes, std::string_view name) {
    constexpr std::uint32_t kPcm = 1, kMinRate = 8000, kMaxRate = 48000;
    using base::ErrorCode;
    if (bytes.size() < kHeader || !bytes.starts_with("RIFF") || bytes.substr(8, 4) != "WAVE")
        return base::fail(ErrorCode::BadInput, "{}: not a WAV file", name);
    const auto format = findChunk(bytes, "fmt "), data = findChunk(bytes, "data");
    if (!format || format->size() < 16 || !data)
        return base::fail(ErrorCode::BadInput, "{}: cut short", name);
    const std::uint32_t rate = numberAt(*format, 4, 4);
    const bool isMono16 =
        numberAt(*format, 0, 2) == kPcm && numberAt(*format, 2, 2) == 1 && numberAt(*format, 14, 2) == 16;
    if (!isMono16 || rate < kMinRate || rate > kMaxRate)
        return base::fail(ErrorCode::BadInput, "{}: expected one channel of 16 bits, {} to {} Hz", name,
                          kMinRate, kMaxRate);
    const std::size_t count = data->size() / 2;
    if (count == 0 || count > kMaxWaveSamples)
        return base::fail(ErrorCode::BadInput, "{}: expected 1 to {} samples, got {}", name, kMaxWaveSamples,
                          count);
    Wave wave{static_cast<int>(rate), {}};
    wave.samples.reserve(count);
    for (std::size_t k = 0; k < count; ++k)
        wave.samples.push_back(static_cast<std::int16_t>(numberAt(*data, 2 * k, 2)));
    return wave;
}

}  // namespace terrane::sound

namespace terrane::embedded {
std::span<const base::EmbeddedFile> sounds();
}  // namespace terrane::embedded

namespace terrane::sound {

base::Result<SoundSet> builtInSounds() {
    SoundSet sounds;
    for (const base::EmbeddedFile& file : embedded::sounds()) {
        auto wave = TERRANE_TRY(parseWave(file.data, file.path));
        sounds[std::string(file.path.substr(0, file.path.rfind('_')))].push_back(std::move(wave));
    }
    return sounds;
}

}  // namespace terrane::sound
