#include "tests/faults/recording_store.h"

#include <gtest/gtest.h>

namespace terrane::store {

int Account::contentAmong(const std::vector<int>& possible, const world::ChunkPtr& chunk) const {
    for (const int content : possible) {
        if (!chunk && content == 0) return 0;
        if (chunk && content > 0 && *contents[static_cast<std::size_t>(content) - 1] == *chunk)
            return content;
    }
    return -1;
}

LoadedChunk RecordingStore::load(world::ChunkPos pos) {
    LoadedChunk loaded = store_->load(pos);
    ++account_.loads;
    account_.note(static_cast<std::uint64_t>(loaded.state));
    if (pos.level > 0) return loaded;
    if (loaded.state == LoadedChunk::State::Damaged) {
        ++account_.unread;
        return loaded;
    }
    const std::vector<int> expected = account_.ledger.expected(pos);
    const bool isGenerated = loaded.chunk && loaded.provenance == Provenance::Generated;
    EXPECT_TRUE(!isGenerated || *loaded.chunk == *account_.generated(pos)) << nameOf(pos);
    const int content = account_.contentAmong(expected, isGenerated ? nullptr : loaded.chunk);
    EXPECT_NE(content, -1) << nameOf(pos) << " is not as it was saved last";
    if (expected.size() > 1) account_.ledger.found(pos, content);
    return loaded;
}

SaveNumber RecordingStore::save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) {
    const SaveNumber number = store_->save(pos, chunk, provenance);
    account_.note(number);
    ++account_.saves;
    if (provenance == Provenance::Generated) return number;
    account_.contents.push_back(std::move(chunk));
    account_.ledger.saved(pos, static_cast<int>(account_.contents.size()), number);
    if (auto edit = account_.unsaved.edited.extract(pos)) account_.unsaved.queued[number] = edit.mapped();
    return number;
}

SaveStatus RecordingStore::status() {
    SaveStatus status = store_->status();
    account_.ledger.durable(status.durable);
    auto& queued = account_.unsaved.queued;
    queued.erase(queued.begin(), queued.upper_bound(status.durable));
    account_.note(status.durable);
    account_.note(status.waiting);
    return status;
}

}  // namespace terrane::store
