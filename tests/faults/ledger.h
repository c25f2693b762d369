// What a store was told to save and what it reported as durable: which content a save may have afterwards.
// Contents are numbers (markedChunk); 0 stands for none.
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
    // All saves up to this number are durable.
    void durable(SaveNumber number) {
        for (auto& [pos, versions] : versions_)
            for (std::size_t k = versions.from; k < versions.contents.size(); ++k)
                if (versions.contents[k].second <= number) versions.from = k;
    }
    // A save has it from the start, or it was found there. Nothing older is possible any more.
    void found(world::ChunkPos pos, int content) { versions_[pos] = {{{content, 0}}, 0}; }
    // Another store counts from 1 again. What the last one was told and did not write may be there or not.
    void closed() {
        for (auto& [pos, versions] : versions_)
            for (auto& [content, number] : versions.contents) number = kNever;
    }

    // What a save may have there.
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
    // What the store that is open may give: the last one that it was told, or what it may have found.
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
        std::vector<std::pair<int, SaveNumber>> contents{{0, 0}};  // oldest first, with their numbers
        std::size_t from = 0;                                      // these are possible
    };
    std::map<world::ChunkPos, Versions> versions_;
};

}  // namespace terrane::store
