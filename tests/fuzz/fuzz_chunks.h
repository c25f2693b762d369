// Wraps bytes of a fuzzer as chunk data, so that they pass the checksum.
#pragma once

#include <xxhash.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "terrane/store/chunks/bytes.h"
#include "terrane/store/chunks/chunk_codec.h"

namespace terrane::fuzz {

inline store::Bytes withChecksum(store::ByteView rest) {
    store::Bytes bytes;
    store::appendNumber(bytes, std::uint64_t{XXH64(rest.data(), rest.size(), 0)});
    store::append(bytes, rest);
    return bytes;
}

inline store::Bytes framed(store::ByteView plain, world::Heights heights) {
    store::Bytes rest;
    store::appendNumber(rest, store::chunkVersion(heights));
    store::appendNumber(rest, static_cast<std::uint32_t>(plain.size()));
    store::appendCompressed(rest, plain);
    return withChecksum(rest);
}

// Wraps the bytes by depth:
//   0  not at all; the checksum is then nearly always wrong
//   1  after a valid checksum: header and compressed data
//   2  compressed and framed: the content, for a world of these heights
inline store::Bytes chunkData(unsigned depth, std::span<const std::uint8_t> bytes, world::Heights heights) {
    const store::ByteView input = std::as_bytes(bytes);
    switch (depth % 3) {
        case 0:
            return {input.begin(), input.end()};
        case 1:
            return withChecksum(input);
        default:
            return framed(input, heights);
    }
}

}  // namespace terrane::fuzz
