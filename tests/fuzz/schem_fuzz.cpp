// libFuzzer: any bytes as a schematic, or as its NBT. A decoded volume survives encoding and decoding again.
#include "terrane/formats/nbt.h"
#include "terrane/formats/schematic.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace terrane;

// Names may be any bytes; only valid ones survive.
bool comesBack(const formats::NamedVolume& volume) {
    for (const formats::NamedState& state : volume.palette) {
        const auto again = formats::namedState(formats::textOf(state));
        if (!again || !(*again == state)) return false;
    }
    return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const formats::LegacyIds ids = *formats::builtInLegacyIds();
    fuzz::FuzzInput input(data, size);
    const bool isPlain = input.byte() % 4 != 0;
    const std::string bytes(input.restAsText());
    const auto volume = formats::decodeSchematic(isPlain ? formats::gzip(bytes) : bytes, ids);
    if (!volume) {
        fuzz::requireReason(volume.error());
        return 0;
    }
    const std::int64_t count = std::int64_t{volume->size.x} * volume->size.y * volume->size.z;
    fuzz::require(count > 0 && static_cast<std::size_t>(count) == volume->cells.size());
    for (const std::uint16_t cell : volume->cells) fuzz::require(cell < volume->palette.size());
    if (!comesBack(*volume)) return 0;
    const auto written = formats::encodeSchematic(*volume);
    fuzz::require(written.has_value());
    const auto back = formats::decodeSchematic(*written, ids);
    fuzz::require(back.has_value() && back->size == volume->size);
    for (std::size_t k = 0; k < volume->cells.size(); ++k)
        fuzz::require(back->palette[back->cells[k]] == volume->palette[volume->cells[k]]);
    return 0;
}
