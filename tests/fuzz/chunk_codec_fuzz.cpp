// libFuzzer: any bytes as a chunk. The first byte says how deep the rest goes:
//   0  the bytes themselves, which the checksum stops nearly always
//   1  behind a checksum that is right: header and compressed data
//   2  compressed and framed: the content
// What the reader takes must come back the same when it is written.
#include <xxhash.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "terrane/store/chunk_codec.h"
#include "terrane/store/compression.h"
#include "terrane/world/block_registry.h"

namespace {

using namespace terrane;
using store::Bytes;
using store::ByteView;

// 200 of the ids have names.
store::BlockIdMap makeIds() {
    const auto registry = world::BlockRegistry::parse(
        "[[block]]\nname = \"stone\"\nshape = \"cube\"\ntexture = \"stone\"\n", "fuzz");
    std::vector<store::SavedName> names = {{0, "air"}, {1, "stone"}, {2, "missing"}};
    for (int id = 3; id < 200; ++id)
        names.push_back({static_cast<world::BlockId>(id), "b" + std::to_string(id)});
    return *store::BlockIdMap::make(*registry, names);
}

Bytes withChecksum(ByteView rest) {
    Bytes bytes;
    store::appendNumber(bytes, std::uint64_t{XXH64(rest.data(), rest.size(), 0)});
    store::append(bytes, rest);
    return bytes;
}

Bytes framed(ByteView plain) {
    Bytes rest;
    store::appendNumber(rest, store::kChunkVersion);
    store::appendNumber(rest, static_cast<std::uint32_t>(plain.size()));
    store::appendCompressed(rest, plain);
    return withChecksum(rest);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const store::BlockIdMap ids = makeIds();
    if (size == 0) return 0;
    const ByteView input = std::as_bytes(std::span(data + 1, size - 1));
    const Bytes bytes = data[0] % 3 == 0   ? Bytes(input.begin(), input.end())
                        : data[0] % 3 == 1 ? withChecksum(input)
                                           : framed(input);
    const auto chunk = store::decodeChunk(bytes, ids);
    if (!chunk) return 0;
    const auto again = store::encodeChunk(*chunk, ids);
    if (!again) std::abort();
    const auto back = store::decodeChunk(*again, ids);
    if (!back || !(*back == *chunk)) std::abort();
    return 0;
}
