// libFuzzer: any bytes as surfaces of a map's cache; the first byte selects how deep they are wrapped.
// Decoded surfaces are complete, and survive encoding and decoding again.
#include <xxhash.h>

#include <vector>

#include "terrane/map/surface_cache.h"
#include "terrane/store/chunks/bytes.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace terrane;

// Repeats the input over the columns: any bytes are valid ones.
store::Bytes surfacesOf(std::span<const std::uint8_t> input) {
    std::vector<std::byte> planes(map::kColumnPlanes * map::kColumnsOfBlob);
    for (std::size_t k = 0; k < planes.size() && !input.empty(); ++k)
        planes[k] = static_cast<std::byte>(input[k % input.size()]);
    store::Bytes bytes;
    store::appendNumber(bytes, std::uint64_t{XXH64(planes.data(), planes.size(), 0)});
    store::appendCompressed(bytes, planes);
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::span<const std::uint8_t> input(data + 1, size - 1);
    const bool isContent = data[0] % 2 == 1;
    const store::ByteView given = std::as_bytes(input);
    const store::Bytes bytes = isContent ? surfacesOf(input) : store::Bytes(given.begin(), given.end());
    const auto columns = map::decodeSurfaces(bytes);
    if (!columns) {
        fuzz::require(!isContent);
        fuzz::requireReason(columns.error());
        return 0;
    }
    fuzz::require(columns->size() == map::kColumnsOfBlob);
    const auto again = map::decodeSurfaces(map::encodeSurfaces(*columns));
    fuzz::require(again && *again == *columns);
    return 0;
}
