// Compares the chunks of a copied world with its history.
#pragma once

#include <filesystem>
#include <map>

#include "tests/net/server_fixture.h"

namespace terrane::net {

using Chunks = std::map<world::ChunkPos, ChunkDifference>;

// The blocks that the history gives, by chunk. Fails if an edit is missing between others.
inline Chunks chunksOfHistory(ServerRecords& records, std::int64_t& newest) {
    Chunks chunks;
    newest = 0;
    const auto take = [&](const LoggedEdit& edit) -> base::Result<void> {
        EXPECT_EQ(edit.number, newest + 1);
        newest = edit.number;
        mergeInto(chunks[edit.chunk], edit.after);
        return {};
    };
    const auto read = records.forEachEdit({}, EditOrder::OldestFirst, take);
    EXPECT_TRUE(read) << read.error().message;
    return chunks;
}

// The chunks on disk are the generated land with the blocks of the history, and nothing else.
inline void expectChunksAreHistory(const std::filesystem::path& save, std::int64_t newest) {
    std::int64_t end = 0;
    Chunks history;
    {
        auto records = SqliteRecords::open(store::serverFilePath(save), contentBlocks()).value();
        history = chunksOfHistory(*records, end);
        EXPECT_EQ(records->historyEnds()->saved, newest) << "nothing is left to be added to the chunks";
    }
    EXPECT_EQ(end, newest);
    auto parts = serverParts(save);
    const auto edited = parts.store->editedChunks().value();
    EXPECT_EQ(edited.size(), history.size());
    for (const world::ChunkPos pos : edited) {
        const auto stored = parts.store->load(pos);
        ASSERT_TRUE(stored.chunk);
        world::Chunk expected = parts.generators.generate(pos);
        applyDifference(expected, history[pos]);
        EXPECT_TRUE(chunkDifference(expected, *stored.chunk).empty()) << pos.x << "," << pos.y;
    }
}

}  // namespace terrane::net
