// libFuzzer: any bytes as a MagicaVoxel model, after a valid header. A decoded model survives encoding and
// decoding again.
#include "terrane/formats/block_volume.h"
#include "terrane/formats/vox_file.h"
#include "tests/fuzz/fuzz_input.h"

using namespace terrane;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::FuzzInput input(data, size);
    const bool hasBeginning = input.byte() % 4 != 0;
    std::string bytes = hasBeginning ? std::string("VOX \x96\0\0\0MAIN\0\0\0\0\0\0\0\0", 20) : std::string();
    bytes += input.restAsText();
    const auto image = formats::decodeVox(bytes);
    if (!image) {
        fuzz::requireReason(image.error());
        return 0;
    }
    const std::int64_t count = std::int64_t{image->size.x} * image->size.y * image->size.z;
    fuzz::require(count > 0 && count <= formats::kMaxVolumeBlocks);
    fuzz::require(static_cast<std::size_t>(count) == image->cells.size());
    if (count > 20000) return 0;  // slow, and covers nothing new
    const auto back = formats::decodeVox(formats::encodeVox(*image));
    fuzz::require(back.has_value() && back->size == image->size && back->cells == image->cells);
    return 0;
}
