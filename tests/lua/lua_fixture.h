// Helpers for tests of scripts: files of scripts, recorded graphs, chunks.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/files.h"
#include "terrane/lua/script.h"
#include "tests/gen/gen_fixture.h"
#include "tests/world/content_blocks.h"

namespace terrane::lua {

inline std::string readText(const std::filesystem::path& path) {
    auto text = base::readFile(path);
    EXPECT_TRUE(text) << path;
    return text ? *std::move(text) : std::string();
}

inline Script exampleScript(std::string_view name) {
    const std::string file = std::string(name) + ".lua";
    return {readText(std::filesystem::path(TERRANE_SOURCE_DIR) / "examples/lua/generators" / file), file};
}

// All scripts of a folder of the source tree, by name.
inline std::vector<std::filesystem::path> scriptsIn(std::string_view folder) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(TERRANE_SOURCE_DIR) / folder)) {
        if (entry.path().extension() == ".lua") found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

inline base::Result<gen::GeneratorGraph> recorded(std::string_view text, int level = 0,
                                                  world::RequestedHeights heights = {}) {
    return recordScript({std::string(text), "test.lua"}, {"test", ""}, contentBlocks(), {level, heights});
}

// The reason why a script fails; empty where it does not.
inline std::string mistakeOf(std::string_view text) {
    const auto graph = recorded(text);
    return graph ? "" : graph.error().message;
}

// The same within a 2D pass; a generator needs a 3D one after it.
inline std::string mistakeInPass(std::string_view text) {
    return mistakeOf("g:pass2D(\"land\", function(p)\n" + std::string(text) +
                     "\nend) g:pass3D(\"ground\", function(p) p:setBlock(\"stone\") end)");
}

inline std::vector<world::BlockId> chunkOf(gen::GeneratorGraph graph, world::ChunkPos pos,
                                           std::uint64_t seed = 1) {
    return gen::blocksOf(gen::Generator(std::move(graph), seed).generate(pos));
}

}  // namespace terrane::lua
