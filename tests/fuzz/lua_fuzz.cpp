// libFuzzer: any text as a generator's script (docs/lua.md). A small recorded graph then generates one chunk.
#include <string>

#include "terrane/gen/generator.h"
#include "terrane/lua/script.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace terrane;

const world::BlockRegistry& fuzzBlocks() {
    static const world::BlockRegistry blocks = [] {
        std::string toml;
        for (const char* name : {"stone",
                                 "dirt",
                                 "grass",
                                 "water",
                                 "sand",
                                 "snow",
                                 "gravel",
                                 "moss",
                                 "basalt",
                                 "poppy",
                                 "oxeye_daisy",
                                 "grass_tuft",
                                 "glowing_mushroom",
                                 "cactus",
                                 "dead_bush",
                                 "reeds",
                                 "savanna_grass",
                                 "sandstone",
                                 "red_sandstone",
                                 "terracotta",
                                 "clay",
                                 "blue_orchid",
                                 "coral_red",
                                 "coral_yellow",
                                 "seagrass",
                                 "oak_log",
                                 "oak_leaves",
                                 "birch_log",
                                 "birch_leaves",
                                 "spruce_log",
                                 "spruce_leaves",
                                 "pine_log",
                                 "pine_leaves",
                                 "acacia_log",
                                 "acacia_leaves",
                                 "willow_log",
                                 "willow_leaves",
                                 "palm_log",
                                 "palm_leaves",
                                 "dead_log",
                                 "mossy_stone",
                                 "mushroom_stem",
                                 "mushroom_cap"})
            toml +=
                std::string("[[block]]\nname = \"") + name + "\"\nshape = \"cube\"\ntexture = \"stone\"\n";
        return *world::BlockRegistry::parse(toml, "blocks.toml");
    }();
    return blocks;
}

std::size_t nodesOf(const gen::GeneratorGraph& graph) {
    std::size_t nodes = 0;
    for (const gen::PassGraph& pass : graph.passes)
        nodes += pass.graph.size() + 100 * pass.graph.loops().size();
    return nodes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::FuzzInput input(data, size);
    const int level = input.byte() % 4;
    const lua::Script script = {std::string(input.restAsText()), "script.lua"};
    auto graph = lua::recordScript(script, {"fuzz", "pack"}, fuzzBlocks(), {level, {}});
    if (!graph) {
        fuzz::requireReason(graph.error());
        fuzz::require(graph.error().message.starts_with("script.lua:"));
        fuzz::require(graph.error().message.find('\n') == std::string::npos);
        return 0;
    }
    if (nodesOf(*graph) > 300 || !graph->drainages.empty()) return 0;
    const gen::Generator generator(*std::move(graph), 1, {.bytes = 1 << 20, .minChunks = 16});
    (void)generator.generate({0, 0, static_cast<std::uint8_t>(level)});
    return 0;
}
