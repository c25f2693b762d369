#include "terrane/volume/areas.h"

#include <gmock/gmock.h>

#include <mutex>
#include <thread>

#include "terrane/store/saves/open_world.h"
#include "tests/base/temp_folder.h"
#include "tests/volume/volume_fixture.h"

namespace terrane::volume {
namespace {

using world::BlockId;

std::unique_ptr<store::ChunkStore> openFile(const std::filesystem::path& file) {
    store::WorldRequest request;
    request.create =
        store::WorldIdentity{kVolumeSeed, "flat", gen::versionOf(gen::builtInGenerators(), "flat")};
    request.versionOf = [](std::string_view name) { return gen::versionOf(gen::builtInGenerators(), name); };
    return store::openWorld(store::worldLocation(file.string()), contentBlocks(), request).value();
}

// A whole region after random edits, against an array with the same edits.
TEST(WriteAreas, RandomEditsAreReadBack) {
    base::TempFolder folder;
    const BlockArea all{-60, -60, 0, 100, 100, 256};
    std::vector<BlockId> expected;
    std::mt19937 random(5);
    {
        const auto world = openWorld("flat", openFile(folder / "edited.sqlite"));
        expected = blocksOf(*world, all);
        for (int k = 0; k < 30; ++k) {
            const BlockArea area = randomArea(random);
            std::vector<BlockId> ids(k % 2 == 0 ? 1 : static_cast<std::size_t>(area.blockCount()));
            for (BlockId& id : ids) id = static_cast<BlockId>(random() % 9);
            std::int64_t changed = 0;
            forEachBlock(area, [&](auto x, auto y, auto z, std::size_t place) {
                BlockId& block = expected[static_cast<std::size_t>(
                    x - all.x0 + all.width() * (y - all.y0 + all.depth() * (z - all.z0)))];
                const BlockId id = ids[ids.size() == 1 ? 0 : place];
                changed += block != id;
                block = id;
            });
            const auto written = writeArea(*world, area, {ids}, {});
            ASSERT_TRUE(written) << written.error().message;
            EXPECT_EQ(*written, changed);
        }
        EXPECT_TRUE(blocksOf(*world, all) == expected);
        ASSERT_TRUE(world->store().flush());
    }
    EXPECT_TRUE(blocksOf(*openWorld("flat", openFile(folder / "edited.sqlite")), all) == expected);
}

TEST(WriteAreas, AnUnknownIdIsRefusedAndNothingIsWritten) {
    const auto world = openWorld("flat");
    const auto types = static_cast<BlockId>(contentBlocks().types().size());
    const std::vector<BlockId> ids = {1, types};
    const auto written = writeArea(*world, {0, 0, 90, 2, 1, 91}, {ids}, {});
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, base::ErrorCode::BadInput);
    EXPECT_THAT(blocksOf(*world, {0, 0, 90, 2, 1, 91}), testing::Each(world::kAir));
}

TEST(WriteAreas, WhatIsThereAlreadyIsNotSaved) {
    const auto world = openWorld("flat");
    const BlockId grass = contentBlock("grass");
    EXPECT_EQ(writeArea(*world, {0, 0, 80, 40, 40, 81}, {std::span(&grass, 1)}, {}).value(), 0);
    EXPECT_FALSE(world->store().contains({0, 0}));
}

// Random values of ids and states, each one for all or one for each, against arrays with the same edits.
TEST(WriteAreas, StatesAreReadBack) {
    const auto world = openWorld("flat");
    const BlockArea all{-20, -20, 70, 30, 30, 110};
    std::vector<BlockId> ids = blocksOf(*world, all);
    std::vector<std::uint16_t> states(ids.size());
    std::mt19937 random(6);
    for (int k = 0; k < 40; ++k) {
        const std::int64_t x = random() % 30, y = random() % 30, z = random() % 20;
        const BlockArea area{x - 20, y - 20, z + 70, x - 10, y - 7, z + 81};
        const auto values = [&](bool isOne, unsigned most) {
            std::vector<std::uint16_t> drawn(isOne ? 1 : static_cast<std::size_t>(area.blockCount()));
            for (std::uint16_t& value : drawn) value = static_cast<std::uint16_t>(random() % most);
            return drawn;
        };
        const auto newIds = values(k % 2 == 0, 3), newStates = values(k % 4 < 2, 5);
        const bool hasStates = k % 5 > 0;
        std::int64_t changed = 0;
        forEachBlock(area, [&](auto bx, auto by, auto bz, std::size_t place) {
            const auto at = static_cast<std::size_t>(
                bx - all.x0 + all.width() * (by - all.y0 + all.depth() * (bz - all.z0)));
            const BlockId id = newIds[newIds.size() == 1 ? 0 : place];
            const std::uint16_t kept = id == ids[at] ? states[at] : std::uint16_t{0};
            const std::uint16_t state = hasStates ? newStates[newStates.size() == 1 ? 0 : place] : kept;
            changed += id != ids[at] || state != states[at];
            ids[at] = id;
            states[at] = state;
        });
        BlockValues written{newIds};
        if (hasStates) written.states = newStates;
        EXPECT_EQ(writeArea(*world, area, written, {}).value(), changed) << k;
    }
    EXPECT_TRUE(blocksOf(*world, all) == ids);
    std::vector<std::uint16_t> read(states.size());
    ASSERT_TRUE(readStates(*world, all, read, {}));
    EXPECT_TRUE(read == states);
}

TEST(WriteAreas, AListenerHearsOfEditedChunks) {
    const auto world = openWorld("flat");
    std::vector<world::ChunkPos> heard;
    std::mutex mutex;
    world->setEditListener([&](std::span<const world::ChunkPos> chunks) {
        const std::lock_guard lock(mutex);
        heard.insert(heard.end(), chunks.begin(), chunks.end());
    });
    const BlockId stone = contentBlock("stone");
    ASSERT_TRUE(writeArea(*world, {15, 3, 90, 17, 4, 91}, {std::span(&stone, 1)}, {}));
    EXPECT_THAT(heard, testing::UnorderedElementsAre(world::ChunkPos{0, 0}, world::ChunkPos{1, 0}));
    ASSERT_TRUE(writeArea(*world, {15, 3, 90, 17, 4, 91}, {std::span(&stone, 1)}, {}));
    EXPECT_EQ(heard.size(), 2u);
    world->setEditListener({});
    ASSERT_TRUE(writeArea(*world, {50, 3, 90, 51, 4, 91}, {std::span(&stone, 1)}, {}));
    EXPECT_EQ(heard.size(), 2u);
}

// Each thread fills blocks of its own in the same chunk.
TEST(WriteAreas, WritesToOneChunkAreAllKept) {
    const auto world = openWorld("flat");
    std::vector<std::thread> threads;
    for (int k = 0; k < 8; ++k)
        threads.emplace_back([&world, k] {
            const auto id = static_cast<BlockId>(k + 1);
            for (int z = 100; z < 120; ++z)
                EXPECT_TRUE(writeArea(*world, {k, 0, z, k + 1, 16, z + 1}, {std::span(&id, 1)}, {}));
        });
    for (std::thread& thread : threads) thread.join();
    const auto blocks = blocksOf(*world, {0, 0, 100, 8, 16, 120});
    for (std::size_t k = 0; k < blocks.size(); ++k) ASSERT_EQ(blocks[k], k % 8 + 1);
}

}  // namespace
}  // namespace terrane::volume
