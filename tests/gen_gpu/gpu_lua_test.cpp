// Scripts run on the GPU as generators in C++ do, with the same blocks as on the CPU.
#include "terrane/base/files.h"
#include "terrane/gen_gpu/gpu_generator.h"
#include "terrane/lua/script.h"
#include "tests/gen/gen_fixture.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/render/content.h"

namespace terrane::gen_gpu {
namespace {

using world::ChunkPos;

class GpuLuaTest : public gpu::GlTest {
  protected:
    void compare(const std::string& name, int level) {
        const std::string file = name + ".lua";
        const auto text = base::readFile(TERRANE_SOURCE_DIR "/examples/lua/generators/" + file);
        ASSERT_TRUE(text) << text.error().message;
        const auto graph = lua::recordScript({*text, file}, {name, ""}, contentBlocks(), {level, {}});
        ASSERT_TRUE(graph) << graph.error().message;
        const gen::Generator cpu(*graph, gen::kTestSeed);
        auto onGpu = GpuGenerator::create(render::contentShaders(), *graph, gen::kTestSeed);
        ASSERT_TRUE(onGpu) << onGpu.error().message;
        std::vector<ChunkPos> chunks;
        for (int k = 0; k < 6; ++k)
            chunks.push_back({k * 7 - 20, k * 5 + 11, static_cast<std::uint8_t>(level)});
        const auto done = gen::generateAll(*onGpu, chunks);
        ASSERT_TRUE(done) << done.error().message;
        for (std::size_t k = 0; k < chunks.size(); ++k) {
            EXPECT_EQ(gen::blocksOf(*(*done)[k]), gen::blocksOf(cpu.generate(chunks[k])))
                << name << " " << testing::PrintToString(chunks[k]);
        }
    }
};

// Between them: stamps, drainage maps, branches, noise in space, reads around.
TEST_F(GpuLuaTest, ScriptsEqualCpu) {
    compare("07_archipelago", 2);
    compare("09_rivers", 0);
    compare("tutorial", 0);
}

}  // namespace
}  // namespace terrane::gen_gpu
