#include "terrane/store/chunks/block_id_map.h"

#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

TEST(BlockIdMap, NewSaveTakesTheRegistrysIds) {
    const auto registry = registryOf({"stone", "dirt"});
    const auto map = BlockIdMap::make(registry, {});
    ASSERT_TRUE(map);
    ASSERT_EQ(map->added().size(), 4u);
    for (const world::BlockType& type : registry.types()) {
        EXPECT_EQ(map->added()[type.id].name, type.name);
        EXPECT_EQ(map->toSaved(type.id), type.id);
        EXPECT_EQ(map->toSession(type.id), type.id);
    }
    EXPECT_EQ(map->toSaved(4), BlockIdMap::kNone);
    EXPECT_EQ(map->toSession(4), BlockIdMap::kNone);
    EXPECT_EQ(map->toSaved(65535), BlockIdMap::kNone);
}

TEST(BlockIdMap, NamesCountNotNumbers) {
    const auto registry = registryOf({"dirt", "stone"});
    const auto map = BlockIdMap::make(registry, {{1, "stone"}, {0, "air"}, {5, "dirt"}, {2, "missing"}});
    ASSERT_TRUE(map);
    EXPECT_TRUE(map->added().empty());
    EXPECT_EQ(map->toSession(1), registry.find("stone")->id);
    EXPECT_EQ(map->toSession(5), registry.find("dirt")->id);
    EXPECT_EQ(map->toSaved(registry.find("stone")->id), 1u);
    EXPECT_EQ(map->toSaved(registry.missing()), 2u);
}

TEST(BlockIdMap, NewTypesTakeFreeIds) {
    const auto registry = registryOf({"lamp", "stone"});
    const auto map = BlockIdMap::make(registry, {{0, "air"}, {1, "stone"}, {3, "gone"}});
    ASSERT_TRUE(map);
    ASSERT_EQ(map->added().size(), 2u);
    EXPECT_EQ(map->added()[0].name, "lamp");
    EXPECT_EQ(map->added()[0].id, 2);
    EXPECT_EQ(map->added()[1].id, 4) << "3 is the id of a type that may come back";
}

TEST(BlockIdMap, UnknownNamesLieBehindTheRegistry) {
    const auto registry = registryOf({"stone"});
    const auto map = BlockIdMap::make(registry, {{0, "air"}, {1, "old"}, {2, "stone"}, {3, "older"}});
    ASSERT_TRUE(map);
    EXPECT_EQ(map->unknown(), (std::vector<std::string>{"old", "older"}));
    const auto old = map->toSession(1), older = map->toSession(3);
    EXPECT_NE(old, older) << "they stay two";
    for (const std::uint32_t id : {old, older}) {
        EXPECT_GE(id, registry.types().size());
        EXPECT_EQ(registry.type(static_cast<world::BlockId>(id)).id, registry.missing());
    }
    EXPECT_EQ(map->toSaved(static_cast<world::BlockId>(old)), 1u);
    EXPECT_EQ(map->toSaved(static_cast<world::BlockId>(older)), 3u);
}

TEST(BlockIdMap, TooManyTypes) {
    std::vector<SavedName> saved;
    for (int id = 0; id < 65536; ++id)
        saved.push_back({static_cast<world::BlockId>(id), "x" + std::to_string(id)});
    EXPECT_FALSE(BlockIdMap::make(registryOf({"stone"}), saved));
    saved.resize(65533);  // air, stone and missing fit
    EXPECT_TRUE(BlockIdMap::make(registryOf({"stone"}), saved));
    saved.push_back({65533, "y"});
    EXPECT_FALSE(BlockIdMap::make(registryOf({"stone"}), saved));
}

// A file whose table has lost its primary key.
TEST(BlockIdMap, AnIdThatStandsForTwoTypesIsDamage) {
    for (const char* second : {"dirt", "unknown"}) {
        const auto map = BlockIdMap::make(registryOf({"stone", "dirt"}), {{1, "stone"}, {1, second}});
        ASSERT_FALSE(map);
        EXPECT_EQ(map.error().code, base::ErrorCode::Damaged);
        EXPECT_EQ(map.error().message, "block id 1 stands for two block types");
    }
}

}  // namespace
}  // namespace terrane::store
