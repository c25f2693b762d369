// Collects saves and writes them in batches on its own thread. Failed writes, for example because the disk is
// full, are queued and tried again. Any thread may call everything.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "terrane/base/timing.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store/chunks/bytes.h"
#include "terrane/store/chunks/entity_budget.h"

namespace terrane::store {

struct QueuedChunk {
    world::ChunkPtr chunk;
    Provenance provenance = Provenance::Generated;
    std::int64_t version = 0;  // ChunkStore::setVersion()
};

// A row that is not a valid chunk: it is quarantined if it still has the same bytes.
struct DamagedRow {
    world::ChunkPos pos;
    std::uint64_t hash = 0;  // hashOfRow() of its data, which may be large
    std::string reason;
};

std::uint64_t hashOfRow(ByteView data);

// The order of keys in a store.
struct KeyOrder {
    bool operator()(world::ChunkPos a, world::ChunkPos b) const {
        return std::tie(a.level, a.x, a.y) < std::tie(b.level, b.x, b.y);
    }
};

using ChunkPosSet = std::set<world::ChunkPos, KeyOrder>;

// Sorted by key, so that pages of a file are filled one after the other.
using QueuedChunks = std::map<world::ChunkPos, QueuedChunk, KeyOrder>;
std::vector<ChunkRow> editedOf(const QueuedChunks& chunks);  // of level 0

struct SaveBatch {
    QueuedChunks chunks;
    std::map<std::string, std::string> metadata;
    std::list<DamagedRow> damaged;

    bool isEmpty() const { return chunks.empty() && metadata.empty() && damaged.empty(); }
};

// A clock that tests set, for queues without a thread: they write on the calling thread, in writeIfDue(),
// flush() and the destructor. It outlives its queue.
struct ManualClock {
    std::chrono::steady_clock::time_point now{};
    std::function<void()> writeIfDue;  // of the queue that has the clock
};

constexpr int kTryAgainDelays = 2;
// Saving must have worked for this time before the log tells so: on a full disk some batches fit.
constexpr int kQuietDelays = 10;

struct SaveLimits {
    // Queued saves are written after this time, or once there are this many chunks of about 10 KB. A failed
    // write is retried after kTryAgainDelays times this time.
    std::chrono::milliseconds delay{1000};
    std::size_t chunks = 1024;
    // Maximum block entity data of loaded chunks that are still held. A chunk beyond it is not loaded and
    // stays in the save.
    std::size_t entityBytes = kEntityBudgetBytes;
    ManualClock* clock = nullptr;  // null: the queue has a thread and uses the system's clock
};

class SaveQueue {
  public:
    // Makes all of a batch durable, or nothing of it. The queue calls it on its thread, never concurrently.
    using WriteBatch = std::function<base::Result<void>(const SaveBatch&)>;

    SaveQueue(WriteBatch write, SaveLimits limits);
    ~SaveQueue();  // writes queued saves; those that fail are lost, and logged unless flush() reported them
    SaveQueue(const SaveQueue&) = delete;
    SaveQueue& operator=(const SaveQueue&) = delete;

    SaveNumber add(world::ChunkPos pos, QueuedChunk chunk);
    SaveNumber add(const std::string& name, std::string value);
    void add(DamagedRow row);

    std::optional<QueuedChunk> find(world::ChunkPos pos);  // queued or being written
    // Returns the queued chunks in the order of `positions`, as of one moment.
    std::vector<std::optional<QueuedChunk>> findMany(std::span<const world::ChunkPos> positions);
    // Returns all that is queued or being written at the moment at which it calls `look`. Meanwhile nothing
    // is queued and no attempt begins or ends: what `look` finds written, with the result, is exactly what
    // was queued so far.
    SaveBatch unsaved(const std::function<void()>& look);
    std::shared_ptr<void> hold();              // see ChunkStore::together()
    [[nodiscard]] base::Result<void> flush();  // see ChunkStore::flush()
    SaveStatus status();

  private:
    using Clock = std::chrono::steady_clock;

    void run();
    void writeIfDue();
    Clock::time_point now() const { return limits_.clock ? limits_.clock->now : Clock::now(); }
    bool isDue() const;
    void writeOnce(std::unique_lock<std::mutex>& lock, bool isLast);
    void reportIfDue();
    void requeue(SaveBatch failed);
    std::optional<QueuedChunk> findLocked(world::ChunkPos pos) const;
    template <class Add>
    SaveNumber addNumbered(Add add);

    WriteBatch write_;
    SaveLimits limits_;
    mutable std::mutex mutex_;
    std::condition_variable wake_, written_;
    SaveBatch waiting_, writing_;
    SaveNumber queued_ = 0, durable_ = 0;
    Clock::time_point due_ = Clock::time_point::max();    // deadline of the queued saves
    std::uint64_t attempts_ = 0, requestedAttempts_ = 0;  // begun; requested by flush
    std::uint64_t finished_ = 0;                          // attempts
    base::Error problem_;                                 // of the last attempt; no message if it succeeded
    base::FailureReport report_;                          // to the log
    Clock::time_point failingSince_;                      // while there is a problem
    bool isProblemReported_ = false;                      // reported by flush(), and nothing was added since
    bool isEnding_ = false;
    int holds_ = 0;
    std::thread thread_;  // none with a ManualClock
};

}  // namespace terrane::store
