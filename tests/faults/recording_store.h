// A store that records the calls, reports and answers of another one, and fails the test for wrong answers.
#pragma once

#include <functional>
#include <map>
#include <memory>

#include "terrane/stream/chunk_table.h"
#include "tests/faults/ledger.h"

namespace terrane::store {

// Visible edits that are not in the save yet, and when they were made.
struct Unsaved {
    std::map<world::ChunkPos, stream::Time> edited;  // time of the oldest unsaved edit
    std::map<SaveNumber, stream::Time> queued;       // by save number
};

// State that outlives stores: each store is opened after the previous one was closed.
struct Account {
    Ledger ledger;
    std::vector<world::ChunkPtr> contents;  // numbered from 1
    Unsaved unsaved;
    std::function<world::ChunkPtr(world::ChunkPos)> generated;
    std::uint64_t history = 0xCBF2'9CE4'8422'2325;
    long loads = 0, saves = 0, unread = 0;

    void note(std::uint64_t value) { history = (history ^ value) * 0x100'0000'01B3; }
    // The matching content among the possible ones; -1 if none matches.
    int contentAmong(const std::vector<int>& possible, const world::ChunkPtr& chunk) const;
};

class RecordingStore : public ChunkStore {
  public:
    RecordingStore(std::unique_ptr<ChunkStore> store, Account& account)
        : store_(std::move(store)), account_(account) {}

    LoadedChunk load(world::ChunkPos pos) override;
    bool contains(world::ChunkPos pos) override { return store_->contains(pos); }
    [[nodiscard]] base::Result<std::vector<world::ChunkPos>> editedChunks() override {
        return store_->editedChunks();
    }
    std::optional<std::string> metadata(std::string_view name) override { return store_->metadata(name); }
    const WorldIdentity& identity() const override { return store_->identity(); }

    SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) override;
    SaveNumber setMetadata(std::string_view name, std::string value) override {
        return store_->setMetadata(name, std::move(value));
    }
    [[nodiscard]] base::Result<void> flush() override { return store_->flush(); }
    SaveStatus status() override;
    void setDerivedRows(DerivedRows rows) override { store_->setDerivedRows(std::move(rows)); }
    [[nodiscard]] base::Result<void> deriveAll(std::string_view rules) override {
        return store_->deriveAll(rules);
    }
    bool isPersistent() const override { return store_->isPersistent(); }

  private:
    std::unique_ptr<ChunkStore> store_;
    Account& account_;
};

}  // namespace terrane::store
