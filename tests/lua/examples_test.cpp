// The examples record at every level and give land; each has what its head promises.
#include <algorithm>

#include "tests/lua/lua_fixture.h"

namespace terrane::lua {
namespace {

using world::ChunkPos;

TEST(Examples, RecordAtEveryLevel) {
    for (const auto& path : scriptsIn("examples/lua/generators")) {
        const Script script{readText(path), path.filename()};
        for (int level = 0; level <= world::kMaxLevel; ++level) {
            const auto graph = recordScript(script, {path.stem(), ""}, contentBlocks(), {level, {}});
            ASSERT_TRUE(graph) << graph.error().message;
            if (level % 5 != 0) continue;
            const auto blocks = chunkOf(*graph, {3, -2, static_cast<std::uint8_t>(level)});
            EXPECT_TRUE(std::any_of(blocks.begin(), blocks.end(),
                                    [](world::BlockId id) { return id != world::kAir; }))
                << path << " level " << level;
        }
    }
}

struct Promise {
    const char* name;
    std::vector<const char*> blocks;
};

TEST(Examples, HaveTheirBlocks) {
    const Promise promises[] = {{"01_flat", {"grass", "poppy"}},
                                {"02_hills", {"grass", "water", "sand", "grass_tuft"}},
                                {"03_mountains", {"snow", "stone", "grass"}},
                                {"04_caves", {"limestone", "glowing_mushroom"}},
                                {"05_desert", {"sand", "cactus", "red_sandstone"}},
                                {"06_canyon", {"terracotta", "red_sandstone", "water"}},
                                {"07_archipelago", {"water", "sand", "palm_log", "coral_red"}},
                                {"08_forest", {"oak_log", "spruce_leaves", "fern"}},
                                {"09_rivers", {"water", "grass", "gravel"}},
                                {"10_islands_in_the_sky", {"grass", "crystal", "limestone"}}};
    for (const Promise& promise : promises) {
        auto graph = recordScript(exampleScript(promise.name), {promise.name, ""}, contentBlocks());
        ASSERT_TRUE(graph) << graph.error().message;
        const gen::Generator generator(*std::move(graph), 1);
        std::vector<bool> isThere(contentBlocks().types().size());
        // Far from each other, so that different land is seen.
        for (int k = 0; k < 60; ++k) {
            for (const world::BlockId id : gen::blocksOf(generator.generate({k * 7 - 200, k * 11 % 97 - 40})))
                isThere[id] = true;
        }
        for (const char* block : promise.blocks)
            EXPECT_TRUE(isThere[contentBlock(block)]) << promise.name << ": " << block;
    }
}

}  // namespace
}  // namespace terrane::lua
