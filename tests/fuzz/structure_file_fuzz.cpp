// libFuzzer: any bytes as a structure; the first byte selects how deep they are wrapped. A decoded structure
// survives encoding and decoding again, including texts of signs.
#include <xxhash.h>

#include "terrane/store/chunks/bytes.h"
#include "terrane/store/chunks/structure_file.h"
#include "terrane/world/blocks/sign.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace terrane;

constexpr std::uint64_t kMagic = 0x7572745372726554;

// The bytes unchanged, after a valid header, or as the content.
store::Bytes structureData(unsigned depth, std::span<const std::uint8_t> input) {
    const store::ByteView bytes = std::as_bytes(input);
    if (depth % 3 == 0) return {bytes.begin(), bytes.end()};
    store::Bytes rest, out;
    if (depth % 3 == 2) {
        store::appendNumber(rest, store::kStructureVersion);
        store::appendNumber(rest, static_cast<std::uint32_t>(bytes.size()));
        store::appendCompressed(rest, bytes);
    } else {
        store::append(rest, bytes);
    }
    store::appendNumber(out, kMagic);
    store::appendNumber(out, std::uint64_t{XXH64(rest.data(), rest.size(), 0)});
    store::append(out, rest);
    return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const auto structure = store::decodeStructure(structureData(data[0], {data + 1, size - 1}));
    if (!structure) {
        fuzz::requireReason(structure.error());
        return 0;
    }
    fuzz::require(structure->cells.size() == static_cast<std::size_t>(structure->blockCount()));
    for (const world::StructureData& entry : structure->data) {
        const auto text = world::decodeSign(*entry.data);
        fuzz::require(!text || world::encodeSign(*text) == *entry.data);
    }
    const auto again = store::encodeStructure(*structure);
    fuzz::require(again.has_value());
    const auto back = store::decodeStructure(*again);
    fuzz::require(back && *back == *structure);
    return 0;
}
