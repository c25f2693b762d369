// libFuzzer: any bytes as a chunk; the first byte selects how deep they are wrapped, and the heights of the
// world. A decoded chunk survives encoding and decoding again.
#include "terrane/world/blocks/block_registry.h"
#include "tests/fuzz/fuzz_chunks.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace terrane;

// 200 of the ids have names.
store::BlockIdMap makeIds() {
    const auto registry = world::BlockRegistry::parse(
        "[[block]]\nname = \"stone\"\nshape = \"cube\"\ntexture = \"stone\"\n", "fuzz");
    std::vector<store::SavedName> names = {{0, "air"}, {1, "stone"}, {2, "missing"}};
    for (int id = 3; id < 200; ++id)
        names.push_back({static_cast<world::BlockId>(id), "b" + std::to_string(id)});
    return *store::BlockIdMap::make(*registry, names);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const store::BlockIdMap ids = makeIds();
    if (size == 0) return 0;
    constexpr world::Heights kHeights[] = {{}, {-64, 320}, {-2048, 2048}, {512, 528}};
    const world::Heights heights = kHeights[data[0] / 3 % std::size(kHeights)];
    const auto chunk =
        store::decodeChunk(fuzz::chunkData(data[0], {data + 1, size - 1}, heights), ids, heights);
    if (!chunk) {
        fuzz::requireReason(chunk.error());
        return 0;
    }
    const auto again = store::encodeChunk(*chunk, ids);
    fuzz::require(again.has_value());
    const auto back = store::decodeChunk(*again, ids, heights);
    fuzz::require(back && *back == *chunk);
    return 0;
}
