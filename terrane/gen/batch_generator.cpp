#include "terrane/gen/batch_generator.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>

#include "terrane/base/job_system.h"

namespace terrane::gen {
namespace {

using world::ChunkPos;

constexpr std::size_t kMaxCpuBatch = 64;
constexpr std::size_t kCpuBatchesInFlight = 3;

// Chunks that several threads generate together.
class CpuBatch {
  public:
    explicit CpuBatch(std::span<const ChunkPos> positions)
        : count_(positions.size()), chunks_(positions.size()) {
        for (std::size_t k = 0; k < positions.size(); ++k) chunks_[k].pos = positions[k];
    }

    // Any thread: generates chunks that no other thread has begun until there are none.
    void work(const Generator& generator) {
        for (std::size_t k = next_++; k < count_; k = next_++) {
            try {
                chunks_[k].chunk = std::make_shared<world::Chunk>(generator.generate(chunks_[k].pos));
            } catch (...) {
                const std::lock_guard lock(mutex_);
                if (!error_) error_ = std::current_exception();
            }
            if (++done_ == count_) done_.notify_all();
        }
    }

    bool isDone() const { return done_ == count_; }
    void wait() const {
        for (std::size_t done = done_; done != count_; done = done_) done_.wait(done);
    }
    // Once it is done; others may still be in work(), and see that there is nothing left.
    std::vector<GeneratedChunk> result() {
        if (error_) std::rethrow_exception(error_);
        return std::move(chunks_);
    }

  private:
    const std::size_t count_;
    std::vector<GeneratedChunk> chunks_;
    std::atomic<std::size_t> next_ = 0, done_ = 0;
    std::mutex mutex_;
    std::exception_ptr error_;
};

class CpuBatchGenerator : public BatchGenerator {
  public:
    CpuBatchGenerator(Generator generator, unsigned threads) : generator_(std::move(generator)) {
        if (threads > 1) helpers_.emplace(threads - 1);
    }

    std::size_t submit(std::span<const ChunkPos> positions) override {
        if (inFlight_.size() == kCpuBatchesInFlight || positions.empty()) return 0;
        const auto taken = positions.first(std::min(positions.size(), kMaxCpuBatch));
        for (const ChunkPos pos : taken) requireGenerated(pos, level());
        auto batch = std::make_shared<CpuBatch>(taken);
        for (unsigned k = 0; helpers_ && k < helpers_->threadCount(); ++k)
            helpers_->submit(0, [this, batch] { batch->work(generator_); });
        inFlight_.push_back(std::move(batch));
        return taken.size();
    }

    std::vector<GeneratedChunk> take(bool wait) override {
        if (inFlight_.empty()) return {};
        const std::shared_ptr<CpuBatch> oldest = inFlight_.front();
        if (wait || !helpers_) {
            oldest->work(generator_);
            oldest->wait();
        }
        if (!oldest->isDone()) return {};
        inFlight_.pop_front();
        return oldest->result();
    }

    std::string_view backend() const override { return "cpu"; }
    int level() const override { return generator_.level(); }

  private:
    Generator generator_;
    std::deque<std::shared_ptr<CpuBatch>> inFlight_;
    std::optional<base::JobSystem> helpers_;  // ends before the generator does
};

}  // namespace

std::unique_ptr<BatchGenerator> makeCpuGenerator(Generator generator, unsigned threads) {
    return std::make_unique<CpuBatchGenerator>(std::move(generator), threads);
}

base::Result<std::vector<std::shared_ptr<world::Chunk>>> generateAll(BatchGenerator& generator,
                                                                     std::span<const ChunkPos> positions) {
    for (const ChunkPos pos : positions) {
        TERRANE_TRY(checkGenerated(pos, generator.level()));
    }
    std::vector<std::shared_ptr<world::Chunk>> chunks;
    chunks.reserve(positions.size());
    std::span<const ChunkPos> waiting = positions;
    while (chunks.size() < positions.size()) {
        while (!waiting.empty()) {
            const std::size_t taken = generator.submit(waiting);
            if (taken == 0) break;
            waiting = waiting.subspan(taken);
        }
        // Batches come back in the order in which they were submitted.
        for (GeneratedChunk& done : generator.take(true)) chunks.push_back(std::move(done.chunk));
    }
    return chunks;
}

}  // namespace terrane::gen
