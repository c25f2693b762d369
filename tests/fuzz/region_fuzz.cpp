// libFuzzer: any bytes as a region file, and any NBT as one of its chunks: read, mapped and converted to a
// Terrane chunk.
#include "terrane/content/built_in.h"
#include "terrane/formats/minecraft_chunk.h"
#include "terrane/formats/region_file.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace terrane;

struct Tables {
    world::BlockRegistry blocks = *content::loadBlocks();
    formats::BlockMapping mapping = *formats::loadMapping(blocks, {});
    formats::LegacyIds ids = *formats::builtInLegacyIds();
};

const Tables& tables() {
    static const Tables tables;
    return tables;
}

void importChunk(std::string_view nbt, int shift) {
    const auto root = formats::decodeNbt(nbt);
    if (!root) return fuzz::requireReason(root.error());
    const auto chunk = formats::decodeAnvilChunk(root->compound, tables().ids);
    if (!chunk) return fuzz::requireReason(chunk.error());
    formats::ImportCounts counts;
    const world::Heights heights = shift % 2 == 0 ? world::Heights() : world::Heights{-64, 320};
    const world::Chunk made = formats::toChunk(*chunk, tables().mapping, {shift, heights}, counts);
    (void)formats::sectionRangeOf(root->compound);
    std::uint64_t all = 0;
    for (const auto& [name, count] : counts.blocks) all += count;
    fuzz::require(all == chunk->sections.size() * formats::kAnvilSectionBlocks);
    fuzz::require(made.block(0) < tables().blocks.types().size());
}

}  // namespace

// Reads the tables first: under the sanitizers that takes seconds, which would count as the time of an input.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
    tables();
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::FuzzInput input(data, size);
    const std::uint8_t kind = input.byte();
    if (kind % 2 == 0) {
        importChunk(input.restAsText(), static_cast<std::int8_t>(kind));
        return 0;
    }
    // A table with one entry, then sectors.
    std::string region(8192, '\0');
    const int number = static_cast<int>(input.number(2) % formats::kRegionChunks);
    for (std::size_t k = 0; k < 4; ++k)
        region[static_cast<std::size_t>(number) * 4 + k] = static_cast<char>(input.byte());
    region += input.restAsText();
    const auto external = [&]() -> base::Result<std::string> { return region; };
    const auto nbt = formats::readRegionChunk(region, number, external);
    if (nbt)
        importChunk(*nbt, 0);
    else
        fuzz::requireReason(nbt.error());
    return 0;
}
