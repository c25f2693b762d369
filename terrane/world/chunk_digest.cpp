#include "terrane/world/chunk_digest.h"

#include <array>
#include <span>

namespace terrane::world {

void addToDigest(base::Digest& digest, const Chunk& chunk) {
    std::array<Section::Value, kBlocksPerSection> values;
    for (int s = 0; s < kSectionsPerChunk; ++s) {
        chunk.section(s).unpack(values);
        digest.update(std::as_bytes(std::span(values)));
    }
}

}  // namespace terrane::world
