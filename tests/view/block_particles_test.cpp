#include "terrane/view/block_particles.h"

#include <gtest/gtest.h>

#include "tests/world/content_blocks.h"
#include "tests/world/put_block.h"

namespace terrane::view {
namespace {

class BlockParticlesTest : public testing::Test {
  protected:
    BlockParticlesTest() {
        world_.insert({0, 0}, std::make_shared<world::Chunk>());
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x) world::putBlock(world_, {x, y, 49}, contentBlock("stone"));
    }
    world::World world_;
    BlockParticles particles_;
};

TEST_F(BlockParticlesTest, FallToTheGroundAndEnd) {
    particles_.burst({8, 8, 50}, contentBlock("dirt"));
    EXPECT_EQ(particles_.particles().size(), BlockParticles::kParticlesPerBlock);
    bool fell = false;
    for (int frame = 0; frame < 60 && !particles_.particles().empty(); ++frame) {
        particles_.advance(1.0 / 60, world_, contentBlocks());
        for (const Particle& p : particles_.particles()) {
            EXPECT_GE(p.position.z, 50) << "none is in the ground";
            EXPECT_EQ(p.block, contentBlock("dirt"));
            fell |= p.velocity.z < 0;
        }
    }
    EXPECT_TRUE(fell);
    EXPECT_TRUE(particles_.particles().empty());
}

TEST_F(BlockParticlesTest, ThereIsAMaximum) {
    for (int k = 0; k < 100; ++k) particles_.burst({8, 8, 50}, contentBlock("dirt"));
    EXPECT_EQ(particles_.particles().size(), BlockParticles::kMaxParticles);
}

}  // namespace
}  // namespace terrane::view
