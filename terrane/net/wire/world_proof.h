// Checks that two programs generate the same world: the client compares the server's fingerprint with its
// own, and proves it by digests of chunks that the server chose. Any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/generator.h"
#include "terrane/store/saves/world_identity.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::net {

struct WorldFingerprint {
    store::WorldIdentity identity;
    std::uint64_t graph = 0;   // gen::graphHash() of level 0
    std::uint64_t blocks = 0;  // blocksHash()
    bool operator==(const WorldFingerprint&) const = default;
};

WorldFingerprint worldFingerprint(const store::WorldIdentity& identity, const gen::GeneratorGraph& graph,
                                  const world::BlockRegistry& blocks);

// Hash of the block names in the order of ids, and of the blocks' behavior: with equal hashes, ids have the
// same meaning and edits the same effects in both programs.
std::uint64_t blocksHash(const world::BlockRegistry& blocks);

// One line that describes the difference of two worlds; empty if there is none.
std::string differenceOf(const WorldFingerprint& server, const WorldFingerprint& client);

// Several chunks, since one may be equal by chance, such as open sea. Generating eight takes 12 ms for the
// overworld and 190 to 310 ms for the continents, where each needs its own rivers (one core, measured once).
constexpr std::size_t kSampleChunks = 8;
using SamplePositions = std::array<world::ChunkPos, kSampleChunks>;
using SampleDigests = std::array<std::uint64_t, kSampleChunks>;

// Positions within 2^20 chunks of the origin, which depend on `random`.
SamplePositions samplePositions(std::uint64_t random);
// xxHash64 of all blocks of the chunk, 16 bits each in the order of their index: generators that differ at
// any depth have different digests.
std::uint64_t chunkDigest(const world::Chunk& chunk);
SampleDigests sampleDigests(const gen::Generator& generator, const SamplePositions& positions);

}  // namespace terrane::net
