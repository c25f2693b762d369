// Which chunks there are and how far each is: the rules of streaming without threads, clocks or blocks. The
// owner (chunk_pipeline.h) asks what to do next and tells what was done.
//
//   (absent) ─► Loading ─► Active ─► Finishing ─► Visible
//                            ▲ │ ▲───────┘ blocks changed meanwhile
//                            │ ▼
//                            │ (absent): nobody asked for 5 s
//                            └──────────────────────── Visible: the view moved on
//
// Chunks within the view distance ask to be visible, those one ring around them to be active, since a chunk
// can be finished (lit and meshed) only while its eight neighbours are active. One thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <glm/vec2.hpp>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "terrane/world/coords.h"

namespace terrane::stream {

enum class ChunkStage : std::uint8_t { Loading, Active, Finishing, Visible };

class ChunkTable {
  public:
    using Time = std::chrono::steady_clock::time_point;
    static constexpr std::chrono::seconds kUnloadAfter{5};

    // `direction`: where the view goes in x and y, of length 1 or 0; chunks in front come before those
    // behind. False where all is as before.
    bool setView(world::ChunkPos centre, int viewDistance, glm::vec2 direction = {});
    // Somebody else asks for a chunk that is in the world: it is loaded soon and kept for 5 s.
    void request(world::ChunkPos pos, Time now);

    // At most `limit` absent chunks that are to be loaded, most urgent first; they are Loading then.
    std::vector<world::ChunkPos> takeLoads(std::size_t limit);
    // Nobody needs the chunk any more: its load may be given up. What was requested is always loaded.
    bool mayGiveUpLoad(world::ChunkPos pos) const;
    // A Loading chunk is there, or will not come: then it is absent again.
    void loaded(world::ChunkPos pos, Time now);
    void loadEnded(world::ChunkPos pos);

    // At most `limit` chunks that can be made visible, most urgent first; they are Finishing then.
    std::vector<world::ChunkPos> takeFinishes(std::size_t limit);
    // A Finishing chunk is done. False where its blocks or a neighbour's changed meanwhile, or it is out of
    // view: the result is to be dropped; it is Active again.
    bool finished(world::ChunkPos pos);
    // Blocks of a chunk changed: results on the way for it and its neighbours are old.
    void blocksChanged(world::ChunkPos pos);

    // Visible chunks that the view has left; they are Active then.
    std::vector<world::ChunkPos> takeHidden();
    // Active chunks that nobody asked for; they are absent then.
    std::vector<world::ChunkPos> takeUnloads(Time now);

    std::optional<ChunkStage> stageAt(world::ChunkPos pos) const;  // none where it is absent
    bool is(world::ChunkPos pos, ChunkStage stage) const { return stageAt(pos) == stage; }
    bool isAtLeastActive(world::ChunkPos pos) const;
    bool isWanted(world::ChunkPos pos) const {
        return world::chunkDistance(pos, centre_) <= viewDistance_ + 1;
    }
    std::size_t size() const { return entries_.size(); }
    std::size_t loadingCount() const { return loading_; }
    std::size_t finishingCount() const { return finishing_; }
    std::size_t wantedVisible() const { return wantedVisible_; }  // chunks within the view distance
    std::size_t visibleInView() const { return visibleInView_; }
    // The smaller the sooner.
    std::int64_t urgency(world::ChunkPos pos) const;

  private:
    struct Entry {
        ChunkStage stage = ChunkStage::Loading;
        bool isRequested = false;       // of a Loading one
        bool isOld = false;             // of a Finishing one: blocks changed since it was taken
        std::uint8_t activeAround = 0;  // of its eight neighbours; those beyond the world count
        Time asked;
    };

    Entry& entry(world::ChunkPos pos);
    bool isInView(world::ChunkPos pos) const { return world::chunkDistance(pos, centre_) <= viewDistance_; }
    std::uint8_t countActiveAround(world::ChunkPos pos) const;
    void changeActiveAround(world::ChunkPos pos, int change);
    void setStage(world::ChunkPos pos, Entry& e, ChunkStage stage);
    void lookAgainFrom(world::ChunkPos pos, std::size_t& cursor) const;
    void orderOffsets();

    std::unordered_map<world::ChunkPos, Entry, world::ChunkPosHash> entries_;
    world::ChunkPos centre_;
    int viewDistance_ = -1;
    glm::vec2 direction_{};
    std::vector<world::ChunkPos> offsets_;  // of wanted chunks from the centre, most urgent first
    std::vector<std::size_t> rank_;         // place in offsets_ by offset
    std::size_t loadCursor_ = 0;            // chunks before it are not absent
    std::size_t finishCursor_ = 0;          // chunks before it are Finishing or Visible
    std::deque<world::ChunkPos> requests_;  // in the order in which they came, each once
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> waiting_;  // those in requests_
    std::size_t loading_ = 0, finishing_ = 0, wantedVisible_ = 0, visibleInView_ = 0;
};

}  // namespace terrane::stream
