#include "apps/terrane/gpu_workers.h"

#include "apps/terrane/content.h"
#include "terrane/light/light_table.h"
#include "tests/gpu/gl_fixture.h"

namespace terrane::app {
namespace {

class GpuWorkersTest : public gpu::GlTest {};

TEST_F(GpuWorkersTest, AreThereWhereTheGpuIsChosen) {
    const auto blocks = loadBlocks();
    ASSERT_TRUE(blocks) << blocks.error().message;
    const light::LightTable lights(*blocks);
    WorldOptions options;
    options.generator = "flat";
    const auto workers = makeGpuWorkers(Backend::Gpu, options, *blocks, lights);
    ASSERT_TRUE(workers) << workers.error().message;
    EXPECT_EQ(workers->generator->backend(), "gpu");
    EXPECT_EQ(workers->lighter->backend(), "gpu");
    const auto none = makeGpuWorkers(Backend::Cpu, options, *blocks, lights);
    ASSERT_TRUE(none);
    EXPECT_FALSE(none->generator || none->lighter);
    options.generator = "moor";
    EXPECT_FALSE(makeGpuWorkers(Backend::Gpu, options, *blocks, lights));
}

}  // namespace
}  // namespace terrane::app
