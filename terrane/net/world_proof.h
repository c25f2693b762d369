// Whether two programs make the same world: the server tells what its world follows from, the client compares
// that with its own and proves it by digests of chunks that the server chose. Any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "terrane/gen/generator.h"
#include "terrane/gen/generator_graph.h"
#include "terrane/store/world_identity.h"
#include "terrane/world/block_registry.h"

namespace terrane::net {

struct WorldFingerprint {
    store::WorldIdentity identity;
    std::uint64_t graph = 0;   // gen::graphHash() of level 0
    std::uint64_t blocks = 0;  // blocksHash()
    bool operator==(const WorldFingerprint&) const = default;
};

WorldFingerprint worldFingerprint(const store::WorldIdentity& identity, const gen::GeneratorGraph& graph,
                                  const world::BlockRegistry& blocks);

// Of names in the order of ids, and of what blocks do: ids mean the same in two programs whose hashes are
// equal, and edits have the same effects.
std::uint64_t blocksHash(const world::BlockRegistry& blocks);

// One line that says what of two worlds differs; empty where nothing does.
std::string differenceOf(const WorldFingerprint& server, const WorldFingerprint& client);

// Eight: one that is equal by chance, such as open sea, proves little. To make them takes 12 ms of the
// overworld and 190 to 310 ms of the continents, where each lies among rivers of its own (one core, measured
// once).
constexpr std::size_t kSampleChunks = 8;
using SamplePositions = std::array<world::ChunkPos, kSampleChunks>;
using SampleDigests = std::array<std::uint64_t, kSampleChunks>;

// Anywhere within 2^20 chunks of the middle, others for each `random`.
SamplePositions samplePositions(std::uint64_t random);
// xxHash64 of the chunk's blocks, 65,536 × 16 bits in the order of their index.
std::uint64_t chunkDigest(const world::Chunk& chunk);
SampleDigests sampleDigests(const gen::Generator& generator, const SamplePositions& positions);

}  // namespace terrane::net
