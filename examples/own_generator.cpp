// A custom world without a window: blocks from a text, a generator from docs/worldgen.md, and the generated
// terrain printed as seen from above. Usage: own_generator [SEED]
#include <cstdio>
#include <cstdlib>
#include <string>

#include "examples/tutorial_generators.h"
#include "terrane/gen/generator.h"
#include "terrane/world/blocks/block_registry.h"

namespace {

using namespace terrane;

constexpr const char* kBlocks = R"(
block = [
    { name = "grass", shape = "cube", texture = "grass" },
    { name = "sand", shape = "cube", texture = "sand" },
    { name = "stone", shape = "cube", texture = "stone" },
    { name = "snow", shape = "cube", texture = "snow" },
    { name = "water", shape = "liquid", texture = "water", alpha = "blend", opacity = 1, collides = false },
]
)";

char letterOf(const std::string& block) {
    return block == "water"   ? '~'
           : block == "snow"  ? '*'
           : block == "stone" ? '^'
           : block == "sand"  ? ':'
                              : '.';
}

std::string topBlock(const world::Chunk& chunk, const world::BlockRegistry& blocks, int x, int y) {
    int z = chunk.heights().top - 1;
    while (z > chunk.heights().bottom && chunk.block(world::blockIndex(x, y, z)) == world::kAir) --z;
    return blocks.type(chunk.block(world::blockIndex(x, y, z))).name;
}

}  // namespace

int main(int argc, char** argv) {
    const auto blocks = world::BlockRegistry::parse(kBlocks, "blocks");
    if (!blocks) return std::fprintf(stderr, "%s\n", blocks.error().message.c_str()), 1;
    gen::GeneratorBuilder builder("own", *blocks);
    examples::writeStep3(builder);
    auto graph = builder.finish();
    if (!graph) return std::fprintf(stderr, "%s\n", graph.error().message.c_str()), 1;
    const gen::Generator generator(std::move(*graph), argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1);

    constexpr int kChunks = 5;  // per side
    for (int cy = kChunks; cy-- > 0;) {
        std::string rows[world::kChunkSize];
        for (int cx = 0; cx < kChunks; ++cx) {
            const world::Chunk chunk = generator.generate({cx, cy});
            for (int y = 0; y < world::kChunkSize; ++y)
                for (int x = 0; x < world::kChunkSize; ++x)
                    rows[y] += letterOf(topBlock(chunk, *blocks, x, y));
        }
        for (int y = world::kChunkSize; y-- > 0;) std::puts(rows[y].c_str());
    }
}
