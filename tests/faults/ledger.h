// Records the saves of a store and those reported as durable, and thus the possible contents of the save
// afterwards. Contents are numbers (markedChunk); 0 means none.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "terrane/store/chunk_store.h"

namespace terrane::store {

class Ledger {
  public:
    void saved(world::ChunkPos pos, int content, SaveNumber number) {
        versions_[pos].contents.push_back({content, number});
    }
    // Reports all saves up to this number as durable.
    void durable(SaveNumber number) {
        for (auto& [pos, versions] : versions_)
            for (std::size_t k = versions.from; k < versions.contents.size(); ++k)
                if (versions.contents[k].second <= number) versions.from = k;
    }
    // The save had this content from the start, or it was found there: nothing older is possible any more.
    void found(world::ChunkPos pos, int content) { versions_[pos] = {{{content, 0}}, 0}; }
    // The store was closed; the next one numbers saves from 1. Saves that were not durable may exist or not.
    void closed() {
        for (auto& [pos, versions] : versions_)
            for (auto& [content, number] : versions.contents) number = kNever;
    }

    // Possible contents in the save.
    std::vector<int> possible(world::ChunkPos pos) const {
        const auto found = versions_.find(pos);
        if (found == versions_.end()) return {0};
        std::vector<int> contents;
        for (std::size_t k = found->second.from; k < found->second.contents.size(); ++k)
            contents.push_back(found->second.contents[k].first);
        return contents;
    }
    bool mayHold(world::ChunkPos pos, int content) const {
        const std::vector<int> contents = possible(pos);
        return std::find(contents.begin(), contents.end(), content) != contents.end();
    }
    // Possible answers of the open store: the last save, or the possible contents of the save.
    std::vector<int> expected(world::ChunkPos pos) const {
        const auto found = versions_.find(pos);
        if (found == versions_.end() || found->second.contents.back().second == kNever) return possible(pos);
        return {found->second.contents.back().first};
    }
    std::vector<world::ChunkPos> positions() const {
        std::vector<world::ChunkPos> all;
        for (const auto& [pos, versions] : versions_) all.push_back(pos);
        return all;
    }

  private:
    static constexpr SaveNumber kNever = ~SaveNumber{0};
    struct Versions {
        std::vector<std::pair<int, SaveNumber>> contents{{0, 0}};  // oldest first, with save numbers
        std::size_t from = 0;                                      // index of the oldest possible content
    };
    std::map<world::ChunkPos, Versions> versions_;
};

}  // namespace terrane::store
