#include "terrane/store/save_queue.h"

#include <xxhash.h>

#include <algorithm>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"
#include "terrane/base/text.h"

namespace terrane::store {
namespace {

// The newer chunk replaces the older one, except a generated chunk after an edited one.
void put(QueuedChunks& chunks, world::ChunkPos pos, QueuedChunk newer) {
    const auto [entry, isNew] = chunks.try_emplace(pos, newer);
    if (!isNew && newer.provenance >= entry->second.provenance) entry->second = std::move(newer);
}

// Short enough for the small string optimization.
base::Error noMemory() {
    return {base::ErrorCode::OutOfResources, "no memory"};
}

// An exception counts as a failed write, so that the queue's thread continues.
base::Result<void> resultOf(const SaveQueue::WriteBatch& write, const SaveBatch& batch) noexcept {
    try {
        try {
            return write(batch);
        } catch (const std::bad_alloc&) {
            return tl::unexpected(noMemory());
        } catch (const std::exception& exception) {
            return base::fail("{}", exception.what());
        }
    } catch (...) {
        return tl::unexpected(noMemory());
    }
}

// Description of a lost batch, metadata by name. A damaged row is not lost: it stays in the file.
std::string listOf(const SaveBatch& batch) {
    std::string text = base::counted(batch.chunks.size(), "chunk");
    for (const auto& [name, value] : batch.metadata) text += fmt::format(", the setting {}", name);
    if (!batch.damaged.empty())
        text += fmt::format(", {} in quarantine", base::counted(batch.damaged.size(), "damaged row"));
    return text;
}

std::string contentOf(const SaveBatch& batch) noexcept {
    try {
        return listOf(batch);
    } catch (const std::bad_alloc&) {
        return "much";
    }
}

}  // namespace

std::vector<ChunkRow> editedOf(const QueuedChunks& chunks) {
    std::vector<ChunkRow> edited;
    for (const auto& [pos, chunk] : chunks)
        if (pos.level == 0 && chunk.provenance == Provenance::Edited) edited.push_back({pos, chunk.chunk});
    return edited;
}

SaveQueue::SaveQueue(WriteBatch write, SaveLimits limits)
    : write_(std::move(write)), limits_(limits), report_(kQuietDelays * limits.delay) {
    if (limits_.clock) {
        limits_.clock->writeIfDue = [this] { writeIfDue(); };
    } else {
        thread_ = std::thread([this] { run(); });
    }
}

SaveQueue::~SaveQueue() {
    {
        const std::lock_guard lock(mutex_);
        isEnding_ = true;
    }
    wake_.notify_all();
    if (limits_.clock) {
        limits_.clock->writeIfDue = nullptr;
        writeIfDue();
    } else {
        thread_.join();
    }
    if (!waiting_.isEmpty() && !isProblemReported_)
        base::logError("{}; lost: {}", problem_.message, contentOf(waiting_));
}

template <class Add>
SaveNumber SaveQueue::addNumbered(Add add) {
    SaveNumber number = 0;
    bool wakes = false;
    {
        const std::lock_guard lock(mutex_);
        add();
        isProblemReported_ = false;
        number = ++queued_;
        const bool isFirst = due_ == Clock::time_point::max();
        if (isFirst) due_ = now() + limits_.delay;
        wakes = isFirst || waiting_.chunks.size() >= limits_.chunks;
    }
    if (wakes) wake_.notify_one();
    return number;
}

SaveNumber SaveQueue::add(world::ChunkPos pos, QueuedChunk chunk) {
    return addNumbered([&] { put(waiting_.chunks, pos, std::move(chunk)); });
}

SaveNumber SaveQueue::add(const std::string& name, std::string value) {
    return addNumbered([&] { waiting_.metadata[name] = std::move(value); });
}

std::uint64_t hashOfRow(ByteView data) {
    return XXH64(data.data(), data.size(), 0);
}

void SaveQueue::add(DamagedRow row) {
    (void)addNumbered([&] { waiting_.damaged.push_back(std::move(row)); });
}

std::optional<QueuedChunk> SaveQueue::findLocked(world::ChunkPos pos) const {
    for (const SaveBatch* batch : {&waiting_, &writing_}) {
        const auto found = batch->chunks.find(pos);
        if (found != batch->chunks.end()) return found->second;
    }
    return std::nullopt;
}

std::optional<QueuedChunk> SaveQueue::find(world::ChunkPos pos) {
    const std::lock_guard lock(mutex_);
    return findLocked(pos);
}

std::vector<std::optional<QueuedChunk>> SaveQueue::findMany(std::span<const world::ChunkPos> positions) {
    std::vector<std::optional<QueuedChunk>> found;
    found.reserve(positions.size());
    const std::lock_guard lock(mutex_);
    for (const world::ChunkPos pos : positions) found.push_back(findLocked(pos));
    return found;
}

SaveBatch SaveQueue::unsaved(const std::function<void()>& look) {
    const std::lock_guard lock(mutex_);
    look();
    SaveBatch all = writing_;
    for (const auto& [pos, newer] : waiting_.chunks) put(all.chunks, pos, newer);
    for (const auto& [name, value] : waiting_.metadata) all.metadata.insert_or_assign(name, value);
    all.damaged.insert(all.damaged.end(), waiting_.damaged.begin(), waiting_.damaged.end());
    return all;
}

std::shared_ptr<void> SaveQueue::hold() {
    const std::lock_guard lock(mutex_);
    ++holds_;
    return {this, [](SaveQueue* queue) {
                {
                    const std::lock_guard held(queue->mutex_);
                    --queue->holds_;
                }
                queue->wake_.notify_all();
            }};
}

base::Result<void> SaveQueue::flush() {
    std::unique_lock lock(mutex_);
    const SaveNumber goal = queued_;
    if (durable_ >= goal) return {};
    // A running attempt may have begun without the last saves.
    const std::uint64_t attempt = attempts_ + 1;
    requestedAttempts_ = std::max(requestedAttempts_, attempt);
    wake_.notify_all();
    if (limits_.clock) writeOnce(lock, false);
    written_.wait(lock, [&] { return durable_ >= goal || finished_ >= attempt; });
    if (durable_ >= goal) return {};
    isProblemReported_ = true;
    return tl::unexpected(problem_);
}

SaveStatus SaveQueue::status() {
    const std::lock_guard lock(mutex_);
    SaveStatus status{.queued = queued_,
                      .durable = durable_,
                      .waiting = waiting_.chunks.size() + writing_.chunks.size(),
                      .problem = problem_.message};
    if (!status.problem.empty())
        status.failingSeconds = std::chrono::duration<double>(now() - failingSince_).count();
    return status;
}

// After a failure the number of chunks is ignored, so that a full disk is not retried at each save.
bool SaveQueue::isDue() const {
    if (holds_ > 0) return false;
    if (isEnding_ || requestedAttempts_ > attempts_) return true;
    return (waiting_.chunks.size() >= limits_.chunks && problem_.message.empty()) || now() >= due_;
}

void SaveQueue::run() {
    base::setThreadName("save");
    std::unique_lock lock(mutex_);
    while (true) {
        while (!isDue()) {
            reportIfDue();
            const Clock::time_point next = std::min(due_, report_.reportAt());
            if (holds_ > 0 || next == Clock::time_point::max()) {
                wake_.wait(lock);
            } else {
                wake_.wait_until(lock, next);
            }
        }
        const bool isLast = isEnding_;
        writeOnce(lock, isLast);
        if (isLast) return;
    }
}

void SaveQueue::writeIfDue() {
    std::unique_lock lock(mutex_);
    if (isDue()) {
        writeOnce(lock, isEnding_);
    } else {
        reportIfDue();
    }
}

void SaveQueue::reportIfDue() {
    if (problem_.message.empty() && report_.hasEnded(now())) base::logInfo("saving works again");
}

void SaveQueue::writeOnce(std::unique_lock<std::mutex>& lock, bool isLast) {
    ++attempts_;
    writing_ = std::exchange(waiting_, {});
    due_ = Clock::time_point::max();
    const SaveNumber goal = queued_;
    lock.unlock();
    base::Result<void> done;
    if (!writing_.isEmpty()) done = resultOf(write_, writing_);
    lock.lock();

    if (done) {
        problem_ = {};
        durable_ = goal;
        writing_ = {};
        reportIfDue();
    } else {
        // flush() reports the problem itself; the destructor reports the losses of the last attempt.
        if (report_.hasBegun() && requestedAttempts_ < attempts_ && !isLast)
            base::logError("{}; waiting, tried again every {} s: {}", done.error().message,
                           kTryAgainDelays * static_cast<double>(limits_.delay.count()) / 1000,
                           contentOf(writing_));
        if (problem_.message.empty()) failingSince_ = now();
        problem_ = std::move(done.error());
        requeue(std::exchange(writing_, {}));
    }
    ++finished_;
    written_.notify_all();
}

// Saves queued meanwhile are newer. Allocates no memory, since writing may have failed for lack of it.
void SaveQueue::requeue(SaveBatch failed) {
    for (auto& [pos, newer] : waiting_.chunks) {
        const auto older = failed.chunks.find(pos);
        if (older != failed.chunks.end() && newer.provenance < older->second.provenance)
            newer = older->second;
    }
    waiting_.chunks.merge(failed.chunks);
    waiting_.metadata.merge(failed.metadata);
    waiting_.damaged.splice(waiting_.damaged.begin(), failed.damaged);
    due_ = now() + kTryAgainDelays * limits_.delay;
}

}  // namespace terrane::store
