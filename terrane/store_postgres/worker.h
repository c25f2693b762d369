// A worker takes squares of chunks from the queue of a world in PostgreSQL, generates their missing chunks,
// and continues until the queue is empty. One thread.
#pragma once

#include <functional>
#include <string>

#include "terrane/gen/batch_generator.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store_postgres/connection.h"
#include "terrane/store_postgres/work_queue.h"

namespace terrane::store_postgres {

struct WorkerParts {
    gen::BatchGenerator& generator;  // of the world
    store::ChunkStore& store;        // of the world, opened with WorldSharing::Generating
    ConnectionPool& pool;
    std::string name;
    bool waits = false;  // for more jobs when the queue is empty
    std::function<bool()> stopRequested;
    std::function<void()> onPaused = {};  // called when the queue is paused; may be empty
};

struct WorkerResult {
    std::int64_t jobs = 0;     // finished by this worker
    std::int64_t chunks = 0;   // generated
    std::int64_t skipped = 0;  // already stored
};

// Returns when no job is left or stopRequested(). An unfinished job goes back to the queue.
[[nodiscard]] base::Result<WorkerResult> work(const WorkerParts& parts);

}  // namespace terrane::store_postgres
