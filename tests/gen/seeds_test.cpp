#include "terrane/gen/compile/generator_graph.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <cstdint>
#include <string>

#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

GeneratorGraph named(const std::vector<std::string>& noises, const std::vector<std::string>& randoms) {
    GeneratorGraph g;
    for (const std::string& name : noises) g.noises.push_back({NoiseKind::Perlin2D, name, 8, {1.0f}});
    for (const std::string& name : randoms) g.hashNames.push_back(randomSeedName(name));
    return g;
}

std::uint32_t hashOf(const std::string& text, std::uint64_t worldSeed) {
    return static_cast<std::uint32_t>(XXH3_64bits_withSeed(text.data(), text.size(), worldSeed));
}

// Worlds that were saved go on only while this holds.
TEST(Seeds, AreTheHashOfKindAndNameSeededWithTheWorlds) {
    const std::uint64_t world = 0x123456789ABCDEFu;
    const Seeds seeds = makeSeeds(named({"hills", ""}, {"plant"}), world);
    ASSERT_EQ(seeds.noises.size(), 2u);
    ASSERT_EQ(seeds.hashes.size(), 1u);
    EXPECT_EQ(seeds.noises[0], hashOf("noise hills", world));
    EXPECT_EQ(seeds.noises[1], hashOf("noise ", world));
    EXPECT_EQ(seeds.hashes[0], hashOf("random plant", world));
}

TEST(Seeds, DoNotDependOnThePlaceInTheGenerator) {
    const Seeds few = makeSeeds(named({"hills"}, {"plant"}), 5);
    const Seeds many = makeSeeds(named({"caves", "ore", "hills"}, {"leaf", "plant"}), 5);
    EXPECT_EQ(many.noises[2], few.noises[0]);
    EXPECT_EQ(many.hashes[1], few.hashes[0]);
}

TEST(Seeds, DependOnEveryBitOfTheWorldsSeed) {
    const GeneratorGraph g = named({"hills"}, {"hills"});
    const Seeds base = makeSeeds(g, 0);
    EXPECT_NE(base.noises[0], base.hashes[0]) << "a noise and a random number of one name are different";
    for (int bit = 0; bit < 64; ++bit) {
        const Seeds other = makeSeeds(g, std::uint64_t{1} << bit);
        EXPECT_NE(other.noises[0], base.noises[0]) << bit;
        EXPECT_NE(other.hashes[0], base.hashes[0]) << bit;
    }
}

}  // namespace
}  // namespace terrane::gen
