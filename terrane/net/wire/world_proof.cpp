#include "terrane/net/wire/world_proof.h"

#include <fmt/format.h>

#include "terrane/base/digest.h"
#include "terrane/gen/compile/generator_graph.h"

namespace terrane::net {

WorldFingerprint worldFingerprint(const store::WorldIdentity& identity, const gen::GeneratorGraph& graph,
                                  const world::BlockRegistry& blocks) {
    return {identity, gen::graphHash(graph), blocksHash(blocks)};
}

std::uint64_t blocksHash(const world::BlockRegistry& blocks) {
    std::string text;
    for (const world::BlockType& type : blocks.types()) {
        text += fmt::format("{} {} {} {} {}", type.name, static_cast<int>(type.shape), type.opaqueCube,
                            type.selectable, type.slots);
        for (const world::Box& box : type.collision)
            text += fmt::format(" {},{},{},{},{},{}", box.min.x, box.min.y, box.min.z, box.max.x, box.max.y,
                                box.max.z);
        for (const auto& behavior : type.behaviors) text += fmt::format(" {}", behavior->name);
        text += '\n';
    }
    return base::hash64(text);
}

std::string differenceOf(const WorldFingerprint& server, const WorldFingerprint& client) {
    const auto& theirs = server.identity;
    const auto& ours = client.identity;
    if (theirs.generator != ours.generator)
        return fmt::format("the server's world is made by the generator {}, which this program does not have",
                           theirs.generator);
    if (theirs.heights != ours.heights)
        return fmt::format("the server's world has the layers {}, this program's {}",
                           world::describe(theirs.heights), world::describe(ours.heights));
    if (theirs.generatorVersion != ours.generatorVersion)
        return fmt::format("the server has version {} of the generator {}, this program version {}",
                           theirs.generatorVersion, theirs.generator, ours.generatorVersion);
    if (server.blocks != client.blocks)
        return "the server has other block types than this program: use the same program";
    if (server.graph != client.graph)
        return fmt::format("the server's generator {} {} differs from this program's: use the same program",
                           theirs.generator, theirs.generatorVersion);
    return {};
}

SamplePositions samplePositions(std::uint64_t random) {
    constexpr std::uint64_t kRange = std::uint64_t{1} << 21;
    SamplePositions positions;
    for (std::size_t k = 0; k < kSampleChunks; ++k) {
        const std::uint64_t bits = base::hash64(fmt::format("sample {} {}", random, k));
        const auto coordinate = [&](std::uint64_t part) {
            return static_cast<std::int32_t>(part % kRange) - static_cast<std::int32_t>(kRange / 2);
        };
        positions[k] = {coordinate(bits & 0xFFFFFFFF), coordinate(bits >> 32)};
    }
    return positions;
}

std::uint64_t chunkDigest(const world::Chunk& chunk) {
    std::string bytes;
    const world::Heights heights = chunk.heights();
    bytes.reserve(static_cast<std::size_t>(heights.layers()) * world::kBlocksPerLayer *
                  sizeof(world::BlockId));
    std::array<world::Section::Value, world::kBlocksPerSection> values;
    for (int number = heights.firstSection(); number < heights.endSection(); ++number) {
        chunk.section(number).unpack(values);
        bytes.append(reinterpret_cast<const char*>(values.data()), sizeof(values));
    }
    return base::hash64(bytes);
}

SampleDigests sampleDigests(const gen::Generator& generator, const SamplePositions& positions) {
    SampleDigests digests;
    for (std::size_t k = 0; k < kSampleChunks; ++k)
        digests[k] = chunkDigest(generator.generate(positions[k]));
    return digests;
}

}  // namespace terrane::net
