// libFuzzer: any text as the content file of block types (docs/blocks.md).
#include "terrane/world/blocks/block_registry.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terrane;
    const auto blocks = world::BlockRegistry::parse(fuzz::FuzzInput(data, size).restAsText(), "blocks.toml");
    if (!blocks) {
        fuzz::requireReason(blocks.error());
        return 0;
    }
    for (const world::BlockType& type : blocks->types()) fuzz::require(blocks->find(type.name) == &type);
    const world::BlockRegistry far = blocks->forFarTiles();
    fuzz::require(far.types().size() == blocks->types().size());
    fuzz::require(far.missing() == blocks->missing());
    return 0;
}
