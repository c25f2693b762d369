// libFuzzer: any bytes as NBT, plain or decompressed. Decoded NBT survives encoding and decoding again.
#include "terrane/formats/nbt.h"
#include "tests/fuzz/fuzz_input.h"

using namespace terrane;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::FuzzInput input(data, size);
    const bool isCompressed = input.byte() % 8 == 7;
    const std::string_view bytes = input.restAsText();
    base::Result<std::string> plain = std::string(bytes);
    if (isCompressed) plain = formats::inflate(bytes, std::size_t{1} << 20);
    if (!plain) {
        fuzz::requireReason(plain.error());
        return 0;
    }
    const auto root = formats::decodeNbt(*plain);
    if (!root) {
        fuzz::requireReason(root.error());
        return 0;
    }
    const std::string written = formats::encodeNbt(*root);
    fuzz::require(written.size() <= plain->size());
    const auto back = formats::decodeNbt(written);
    fuzz::require(back.has_value());
    // Compares bytes: a NaN is not equal to itself.
    fuzz::require(formats::encodeNbt(*back) == written);
    return 0;
}
