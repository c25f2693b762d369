// Blocks, chunks and files for the tests of this module.
#pragma once

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <array>
#include <chrono>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "terrane/store/chunk_store.h"
#include "terrane/store/chunks/block_id_map.h"
#include "terrane/store/save_queue.h"
#include "terrane/store/sqlite/sqlite.h"
#include "terrane/world/blocks/block_registry.h"
#include "tests/base/temp_folder.h"
#include "tests/support/default_heights.h"

namespace terrane::store {

// No automatic saves: only flush() and the destructor write.
inline constexpr SaveLimits kNever{.delay = std::chrono::hours(1), .chunks = 1000000};

// A registry of "air", the names, "missing", with ids in this order.
inline world::BlockRegistry registryOf(const std::vector<std::string>& names) {
    std::string toml;
    for (const std::string& name : names)
        toml += "[[block]]\nname = \"" + name + "\"\nshape = \"cube\"\ntexture = \"stone\"\n";
    auto registry = world::BlockRegistry::parse(toml, "test");
    if (!registry) throw std::runtime_error(registry.error().message);
    return std::move(*registry);
}

inline world::BlockRegistry testRegistry() {
    return registryOf({"stone", "dirt", "grass", "sand", "water"});
}

// Maps each of the 65,536 ids to itself: "b0", "b1", …
inline const BlockIdMap& allIds() {
    static const BlockIdMap map = [] {
        std::vector<SavedName> saved;
        const world::BlockRegistry registry = registryOf({"b1"});
        saved.push_back({0, "air"});
        saved.push_back({1, "b1"});
        saved.push_back({2, "missing"});
        for (int id = 3; id < 65536; ++id)
            saved.push_back({static_cast<world::BlockId>(id), "b" + std::to_string(id)});
        return *BlockIdMap::make(registry, saved);
    }();
    return map;
}

inline const WorldIdentity kIdentity{.seed = 7, .generator = "flat", .generatorVersion = 3};

inline world::Section randomSection(std::mt19937& random, int distinct) {
    std::array<world::Section::Value, world::kBlocksPerSection> values;
    std::vector<world::Section::Value> palette;
    for (int i = 0; i < distinct; ++i) palette.push_back(static_cast<world::Section::Value>(random()));
    for (auto& value : values) value = palette[random() % palette.size()];
    return world::Section::fromValues(values);
}

inline world::BlockEntityData randomBytes(std::mt19937& random, std::size_t size) {
    world::BlockEntityData data(size);
    for (std::byte& byte : data) byte = static_cast<std::byte>(random());
    return data;
}

inline world::BlockIndex randomIndex(std::mt19937& random, world::Heights heights = {}) {
    const auto blocks = static_cast<std::uint32_t>(heights.layers() * world::kBlocksPerLayer);
    return heights.bottom * world::kBlocksPerLayer + static_cast<world::BlockIndex>(random() % blocks);
}

// Other heights than 0…255: the usual ones of tall worlds, the highest and lowest ones, and such that 0 is
// not in them.
inline constexpr world::Heights kTallHeights[] = {{-64, 320}, {-2048, 2048}, {512, 1024}, {-1024, -512},
                                                  {0, 16},    {0, 272},      {16, 256}};

// A chunk with sections in all representations, block states and block entity data.
inline world::Chunk randomChunk(std::mt19937& random, world::Heights heights = {}) {
    constexpr int kDistinct[] = {1, 1, 1, 2, 3, 4, 9, 16, 17, 200, 256, 257, 3000};
    world::Chunk chunk(heights);
    for (int n = heights.firstSection(); n < heights.endSection(); ++n) {
        chunk.setSection(n, randomSection(random, kDistinct[random() % std::size(kDistinct)]));
        if (random() % 4 == 0)
            chunk.setBlockStateSection(n, randomSection(random, kDistinct[random() % std::size(kDistinct)]));
    }
    for (std::size_t count = random() % 2 * (random() % 50); count > 0; --count)
        chunk.setBlockEntityData(randomIndex(random, heights), randomBytes(random, random() % 300));
    return chunk;
}

// A chunk of a few of the registry's blocks, different for each number.
inline world::ChunkPtr numberedChunk(int number) {
    auto chunk = std::make_shared<world::Chunk>();
    chunk->setSection(0, world::Section(1));
    for (int bit = 0; bit < 24; ++bit)
        chunk->setBlock(world::blockIndex(bit % 16, bit / 16, 20), number >> bit & 1 ? 2 : 3);
    chunk->setBlockState(world::blockIndex(1, 1, 20), static_cast<std::uint16_t>(number));
    return chunk;
}

inline std::string readAll(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void writeAll(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

// Runs SQL on a file like another program, without this module's rules.
inline void runSql(const std::filesystem::path& path, const std::string& sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    char* message = nullptr;
    const int code = sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &message);
    EXPECT_EQ(code, SQLITE_OK) << message << ": " << sql;
    sqlite3_free(message);
    ASSERT_EQ(sqlite3_close(database), SQLITE_OK);
}

inline std::int64_t queryFile(const std::filesystem::path& path, const std::string& sql) {
    auto database = Database::open(path, OpenMode::ReadWrite);
    if (!database) throw std::runtime_error(database.error().message);
    const auto number = database->queryNumber(sql);
    if (!number) throw std::runtime_error(number.error().message);
    return number->value_or(-1);
}

// Drops privileges: the tests may run as root, for whom nothing is read-only.
class Unprivileged {
  public:
    Unprivileged() : wasRoot_(::geteuid() == 0) {
        if (wasRoot_ && ::seteuid(65534) != 0) throw std::runtime_error("the user cannot be changed");
    }
    ~Unprivileged() {
        if (wasRoot_ && ::seteuid(0) != 0) std::abort();
    }
    Unprivileged(const Unprivileged&) = delete;
    Unprivileged& operator=(const Unprivileged&) = delete;

  private:
    bool wasRoot_;
};

}  // namespace terrane::store
