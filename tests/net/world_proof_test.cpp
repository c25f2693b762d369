#include "terrane/net/wire/world_proof.h"

#include <gtest/gtest.h>

#include <set>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/net/client/remote_session.h"
#include "tests/world/content_blocks.h"

namespace terrane::net {
namespace {

gen::GeneratorGraph graphOf(const std::string& name) {
    return gen::makeGenerator(name, contentBlocks()).value();
}

WorldFingerprint fingerprint(const std::string& generator) {
    return worldFingerprint({1, generator, gen::versionOf(gen::builtInGenerators(), generator)},
                            graphOf(generator), contentBlocks());
}

TEST(WorldProof, EqualProgramsAgree) {
    EXPECT_EQ(fingerprint("continents"), fingerprint("continents"));
    EXPECT_EQ(differenceOf(fingerprint("overworld"), fingerprint("overworld")), "");
}

TEST(WorldProof, EachDifferenceIsToldInOneLine) {
    const WorldFingerprint server = fingerprint("overworld");
    const auto told = [&](auto change) {
        WorldFingerprint client = server;
        change(client);
        return differenceOf(server, client);
    };
    EXPECT_NE(told([](auto& c) { c.identity.generator = "flat"; }).find("overworld"), std::string::npos);
    EXPECT_NE(told([](auto& c) { c.identity.generatorVersion += 1; }).find("version"), std::string::npos);
    EXPECT_EQ(told([](auto& c) {
                  c.identity.heights = {-64, 320};
              }),
              "the server's world has the layers 0 to 255, this program's -64 to 319");
    EXPECT_NE(told([](auto& c) { c.graph ^= 1; }).find("generator"), std::string::npos);
    EXPECT_NE(told([](auto& c) { c.blocks ^= 1; }).find("block types"), std::string::npos);
}

// An offer with an unknown generator but the right blocks.
TEST(WorldProof, AnOfferOfNoGeneratorIsRefused) {
    WorldOffer offer;
    offer.world.blocks = blocksHash(contentBlocks());
    for (const char* name : {"", "nobody"}) {
        offer.world.identity.generator = name;
        EXPECT_FALSE(offeredGenerator(offer, contentBlocks())) << name;
    }
    offer.world = fingerprint("flat");
    EXPECT_TRUE(offeredGenerator(offer, contentBlocks()));
}

TEST(WorldProof, SamplesAreFarApartAndDifferFromTimeToTime) {
    std::set<world::ChunkPos> all;
    for (std::uint64_t random = 0; random < 50; ++random)
        for (const world::ChunkPos pos : samplePositions(random)) {
            EXPECT_LE(world::chunkDistance(pos, {0, 0}), 1 << 20);
            all.insert(pos);
        }
    EXPECT_EQ(all.size(), 50 * kSampleChunks);
    EXPECT_EQ(samplePositions(7), samplePositions(7));
}

TEST(WorldProof, DigestsTellGeneratorsAndSeedsApart) {
    const SamplePositions positions = samplePositions(5);
    const auto digests = [&](const std::string& name, std::uint64_t seed) {
        return sampleDigests(gen::Generator(graphOf(name), seed), positions);
    };
    EXPECT_EQ(digests("overworld", 1), digests("overworld", 1));
    EXPECT_NE(digests("overworld", 1), digests("overworld", 2));
    EXPECT_NE(digests("overworld", 1), digests("continents", 1));
}

// Two generators may differ at any depth.
TEST(WorldProof, ADigestIsOfAllLayers) {
    constexpr world::Heights kHeights{-2048, 2048};
    world::Chunk a(kHeights), b(kHeights);
    for (world::Chunk* chunk : {&a, &b}) chunk->setSection(0, world::Section(1));
    EXPECT_EQ(chunkDigest(a), chunkDigest(b));
    for (const int z : {-2048, -300, 2047}) {
        b = a;
        b.setBlock(world::blockIndex(7, 7, z), 2);
        EXPECT_NE(chunkDigest(a), chunkDigest(b)) << z;
    }
    EXPECT_NE(chunkDigest(world::Chunk()), chunkDigest(a));
}

TEST(WorldProof, AnOfferOfOtherHeightsGivesTheirGenerator) {
    WorldOffer offer;
    offer.world = fingerprint("flat");
    offer.world.identity.heights = {-64, 320};
    offer.world.graph = gen::graphHash(
        gen::makeGenerator("flat", contentBlocks(), gen::GraphRequest{0, world::Heights{-64, 320}}).value());
    const auto generator = offeredGenerator(offer, contentBlocks());
    ASSERT_TRUE(generator) << generator.error().message;
    EXPECT_EQ(generator->heights(), (world::Heights{-64, 320}));
    EXPECT_EQ(generator->generate({3, 4}).heights(), (world::Heights{-64, 320}));
    EXPECT_NE(offer.world.graph, fingerprint("flat").graph);
}

// The digest depends only on the blocks, not on their history.
TEST(WorldProof, ADigestIsOfBlocksAlone) {
    world::Chunk a, b;
    a.setBlock(5, 3);
    b.setBlock(5, 2);
    b.setBlock(700, 2);
    b.setBlock(700, world::kAir);
    EXPECT_NE(chunkDigest(a), chunkDigest(b));
    b.setBlock(5, 3);
    EXPECT_EQ(chunkDigest(a), chunkDigest(b));
}

}  // namespace
}  // namespace terrane::net
