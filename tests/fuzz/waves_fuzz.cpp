// libFuzzer: any bytes as a WAV file.
#include "terrane/sound/sound_set.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terrane;
    const auto wave = sound::parseWave(fuzz::FuzzInput(data, size).restAsText(), "a.wav");
    if (!wave) {
        fuzz::requireReason(wave.error());
        return 0;
    }
    fuzz::require(wave->rate >= 8000 && wave->rate <= 48000);
    fuzz::require(!wave->samples.empty() && 2 * wave->samples.size() <= size);
    return 0;
}
