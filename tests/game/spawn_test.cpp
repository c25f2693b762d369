#include "terrane/game/spawn.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>

#include <cmath>
#include <map>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/language/builder.h"
#include "terrane/world/character.h"
#include "tests/game/session_fixture.h"
#include "tests/support/depth.h"

namespace terrane::game {
namespace {

class BackOnSurface : public SessionTest {
  protected:
    std::optional<world::Pose> from(glm::dvec3 position) const {
        return poseOnSurface(session_.world(), session_.blocks(), {.position = position, .yaw = 30});
    }
};

// Land with this ground; if it is wet, all but one chunk lies under water.
world::Pose spawnOn(const std::function<gen::Block(gen::Pass&)>& cover, bool isWet = false) {
    gen::GeneratorBuilder builder("test", contentBlocks());
    const auto isThere = [](gen::Pass& p) { return p.x() >= 96 && p.x() < 112 && p.y() >= 0 && p.y() < 16; };
    builder.pass3D("ground", [&](gen::Pass& p) {
        const gen::Int z = p.z();
        const gen::Block air =
            isWet ? select(z <= 70 && !isThere(p), p.block("water"), p.block("air")) : p.block("air");
        p.setBlock(select(z <= 64, cover(p), air));
    });
    return findSpawn(gen::Generator(std::move(builder.finish().value()), 1), contentBlocks());
}

TEST(Spawn, IsOnGrassWhereThereIsSome) {
    const auto pose =
        spawnOn([](gen::Pass& p) { return select(p.x() >= 96, p.block("grass"), p.block("sand")); });
    EXPECT_EQ(pose.position, glm::dvec3(104.5, -87.5, 65 + world::kEyeHeight));
}

TEST(Spawn, IsOnOtherDryGroundWhereNoGrassIs) {
    const auto sand = [](gen::Pass& p) { return p.block("sand"); };
    EXPECT_EQ(spawnOn(sand).position, glm::dvec3(8.5, 8.5, 65 + world::kEyeHeight));
    const auto island = spawnOn(sand, true);
    EXPECT_EQ(island.position, glm::dvec3(104.5, 8.5, 65 + world::kEyeHeight)) << "not in the water";
}

TEST(Spawn, IsAtAnyHeight) {
    for (const int ground : {-2040, -700, -1, 1500, 2040}) {
        gen::GeneratorBuilder builder("test", contentBlocks());
        builder.declareHeights({world::kLowestBottom, world::kHighestTop});
        builder.pass3D("ground", [&](gen::Pass& p) {
            p.setBlock(select(p.z() <= ground, p.block("grass"), p.block("air")));
        });
        const auto pose = findSpawn(gen::Generator(std::move(builder.finish().value()), 1), contentBlocks());
        EXPECT_EQ(pose.position, glm::dvec3(8.5, 8.5, ground + 1 + world::kEyeHeight));
    }
}

// Grass at z = 64 and a cliff of 56 blocks that begins 12 blocks from the spawn, in the direction of this
// yaw.
float viewBesideCliff(int yaw) {
    const double angle = glm::radians(double{static_cast<float>(yaw)});
    const int ahead = static_cast<int>(std::lround(std::cos(angle))),
              left = static_cast<int>(std::lround(std::sin(angle)));
    gen::GeneratorBuilder builder("cliff", contentBlocks());
    builder.pass3D("ground", [&](gen::Pass& p) {
        const auto isCliff = (p.x() - 8) * ahead + (p.y() - 8) * left >= 12;
        p.setBlock(select(p.z() <= 64 || (isCliff && p.z() <= 120), p.block("grass"), p.block("air")));
    });
    return findSpawn(gen::Generator(std::move(builder.finish().value()), 1), contentBlocks()).yaw;
}

TEST(FirstView, IsAwayFromACliff) {
    for (const int yaw : {0, 90, 180, 270})
        EXPECT_GT(std::abs(std::remainder(viewBesideCliff(yaw) - static_cast<float>(yaw), 360.0f)), 100)
            << "a cliff at yaw " << yaw;
}

// Blocks that the player sees until the ground rises by more than a tenth of the way, at most 96.
int sightOf(const gen::Generator& generator, const world::Pose& pose, float yaw) {
    std::map<std::pair<int, int>, world::Chunk> chunks;
    for (int distance = 2; distance < 96; distance += 2) {
        const glm::dvec3 at =
            pose.position + glm::dvec3(world::lookDirection(yaw, 0)) * static_cast<double>(distance);
        const world::BlockPos column = world::blockOf(at);
        const world::ChunkPos pos = world::chunkOf(column);
        const auto& chunk = chunks.try_emplace({pos.x, pos.y}, generator.generate(pos)).first->second;
        for (int z = static_cast<int>(at.z + 0.1 * distance); z < generator.heights().top; ++z)
            if (!contentBlocks()
                     .type(chunk.block(world::blockIndex({column.x, column.y, z})))
                     .collision.empty())
                return distance;
    }
    return 96;
}

TEST(FirstView, IsOpenInContinents) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const auto graph = gen::makeGenerator("continents", contentBlocks(), 0).value();
        const gen::Generator generator(graph, seed);
        const world::Pose pose = findSpawn(generator, contentBlocks());
        int farthest = 0;
        for (int k = 0; k < 16; ++k)
            farthest = std::max(farthest, sightOf(generator, pose, 22.5f * static_cast<float>(k)));
        EXPECT_GE(sightOf(generator, pose, pose.yaw), std::min(farthest, 80)) << "seed " << seed;
        EXPECT_EQ(findSpawn(generator, contentBlocks()), pose) << "the same each time";
    }
}

// The spawn of a new world of `wilderness`, whose sea is at z = 0 and whose peaks rise to 1,700.
TEST(WildernessSpawn, IsOnDryLandWithAView) {
    constexpr const char* kName = "wilderness";
    const int seaLevel = gen::seaLevelOf(kName);
    const gen::GeneratorGraph graph = gen::makeGenerator(kName, contentBlocks(), 0).value();
    for (std::uint64_t seed = 1; seed <= atDepth<std::uint64_t>(6, 200); ++seed) {
        SCOPED_TRACE(seed);
        const gen::Generator generator(graph, seed);
        const world::Pose pose = findSpawn(generator, contentBlocks());
        const glm::dvec3 feet = pose.position - glm::dvec3(0, 0, world::kEyeHeight - 0.01);  // rounded
        const world::BlockPos at = world::blockOf(feet);
        const world::Chunk chunk = generator.generate(world::chunkOf(at));
        const auto typeAt = [&](int z) -> const world::BlockType& {
            return contentBlocks().type(chunk.block(world::blockIndex({at.x, at.y, z})));
        };
        EXPECT_GE(at.z, seaLevel) << "on land";
        EXPECT_TRUE(typeAt(at.z - 1).opaqueCube) << "on " << typeAt(at.z - 1).name;
        for (int z = at.z; z < chunk.heights().top; ++z) {
            EXPECT_TRUE(typeAt(z).collision.empty()) << typeAt(z).name << " at " << z;
            EXPECT_NE(typeAt(z).shape, world::Shape::Liquid) << z;
        }
        int open = 0;  // of nine directions on the screen; a single tree may stand in the way
        for (int k = -4; k <= 4; ++k)
            open += sightOf(generator, pose, pose.yaw + 10.0f * static_cast<float>(k)) >= 64;
        EXPECT_GE(open, 5);
    }
}

TEST_F(BackOnSurface, WhoIsBelowTheWorldStandsOnTheGround) {
    const auto pose = from({5.5, 6.5, -4055});
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->position, glm::dvec3(5.5, 6.5, kGroundHeight + world::kEyeHeight));
    EXPECT_EQ(pose->yaw, 30);
}

TEST_F(BackOnSurface, OthersStay) {
    EXPECT_FALSE(from({5.5, 6.5, 0}));
    EXPECT_FALSE(from({5.5, 6.5, 80}));
    EXPECT_FALSE(from({5000, 6.5, -10})) << "no chunk is loaded there";
}

TEST_F(BackOnSurface, NobodyStandsOnAnEmptyColumn) {
    std::vector<EditCommand> commands;
    for (int z = 0; z < kGroundHeight; ++z) commands.push_back({kNoPlayer, {5, 6, z}, world::SetBlock{}, {}});
    session_.edit(commands);
    EXPECT_FALSE(from({5.5, 6.5, -10}));
}

class FreePlaceTest : public SessionTest {
  protected:
    static constexpr world::Pose kSpawn{{5.5, 5.5, kGroundHeight + world::kEyeHeight}, 30, -4};

    void put(world::BlockPos pos, const char* name) {
        session_.edit({kNoPlayer, pos, world::SetBlock{contentBlock(name)}, {}});
    }
    void putAround(int from, int to, int z, const char* name) {
        for (int y = 5 - to; y <= 5 + to; ++y)
            for (int x = 5 - to; x <= 5 + to; ++x)
                if (std::max(std::abs(x - 5), std::abs(y - 5)) >= from) put({x, y, z}, name);
    }
    bool isStanding(const world::Pose& pose) const {
        const glm::dvec3 feet = pose.position - glm::dvec3(0, 0, world::kEyeHeight - 0.01);  // rounded
        const world::Aabb body = world::characterBox(feet);
        const world::Aabb below{body.min - glm::dvec3(0, 0, 0.1), body.max};
        return !world::collides(session_.world(), session_.blocks(), body) &&
               world::collides(session_.world(), session_.blocks(), below) &&
               !world::isInLiquid(session_.world(), session_.blocks(), feet + glm::dvec3(0, 0, 0.1));
    }
    world::Pose freePlace(std::span<const world::Aabb> taken = {}) {
        return freePlaceNear(kSpawn, session_, taken);
    }
};

TEST_F(FreePlaceTest, IsTheSpawnItselfWhereNobodyIs) {
    EXPECT_EQ(freePlace(), kSpawn);
}

TEST_F(FreePlaceTest, PlayersStandBesideEachOther) {
    std::vector<world::Aabb> taken;
    for (int k = 0; k < 200; ++k) {  // more than there are places on the spawn's level
        const world::Pose pose = freePlace(taken);
        EXPECT_TRUE(isStanding(pose)) << k;
        const world::Aabb body = world::characterBox(pose.position - glm::dvec3(0, 0, world::kEyeHeight));
        for (const world::Aabb& other : taken)
            EXPECT_FALSE(glm::all(glm::lessThan(body.min, other.max)) &&
                         glm::all(glm::lessThan(other.min, body.max)));
        taken.push_back(body);
    }
}

TEST_F(FreePlaceTest, IsNotInBlocksThatWereBuiltThere) {
    for (int z = kGroundHeight; z < kGroundHeight + 3; ++z) putAround(0, 6, z, "stone");
    const world::Pose pose = freePlace();
    EXPECT_TRUE(isStanding(pose));
    EXPECT_EQ(pose.position.z, kSpawn.position.z + 3) << "on top of them";
}

TEST_F(FreePlaceTest, IsInsideOfAHouse) {
    putAround(0, 4, kGroundHeight + 4, "stone");  // a roof
    EXPECT_EQ(freePlace(), kSpawn);
    put({5, 5, kGroundHeight}, "stone");
    EXPECT_LT(freePlace().position.z, kSpawn.position.z + 2) << "not on the roof";
}

TEST_F(FreePlaceTest, IsNotInWater) {
    putAround(0, 6, kGroundHeight - 1, "water");
    putAround(0, 6, kGroundHeight, "water");
    const world::Pose pose = freePlace();
    EXPECT_TRUE(isStanding(pose));
    EXPECT_GT(glm::distance(pose.position, kSpawn.position), 6);
}

TEST_F(FreePlaceTest, ChunksThatAreNotLoadedAreReadFromTheStore) {
    SessionParts parts = flatParts();
    auto chunk = std::make_shared<world::Chunk>(session_.generator().generate({0, 0}));
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            chunk->setBlock(world::blockIndex(x, y, kGroundHeight), contentBlock("stone"));
    parts.store->save({0, 0}, chunk, store::Provenance::Edited);
    Session fresh(std::move(parts));
    ASSERT_FALSE(fresh.world().maybeChunkAt({0, 0}));
    EXPECT_EQ(freePlaceNear(kSpawn, fresh, {}).position.z, kSpawn.position.z + 1);
}

}  // namespace
}  // namespace terrane::game
