// Simulates a player who walks and builds in a small world, with pipeline, workers, store, clock and disk on
// one thread; deterministic for a seed. The disk fails, workers are late, the program is closed and killed,
// the power fails.
//
// Invariants: durable saves exist, visible edits are saved within two seconds or the status reports why not,
// no wrong chunk is returned, and without further faults everything gets saved.
#pragma once

#include <optional>

#include "terrane/base/job_system.h"
#include "terrane/store/save_queue.h"
#include "terrane/stream/chunk_pipeline.h"
#include "tests/faults/recording_store.h"
#include "tests/store/faulty_disk.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {

struct SimulationCounts {
    long steps = 0, edits = 0, loads = 0, saves = 0, unread = 0, faults = 0, failedOperations = 0;
    long kills = 0, powerLosses = 0, restarts = 0;
    double seconds = 0;  // simulated time
};

class Simulation {
  public:
    explicit Simulation(unsigned seed);
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    // Violations are reported as GoogleTest failures.
    void run();
    std::uint64_t history() const;  // hash of all events
    SimulationCounts counts() const { return counts_; }

  private:
    bool chance(double share);
    int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(end)); }
    void step();
    void changeFaults();
    void walk();
    void edit();
    void passTime();
    void expectSavedOrTold();

    void open();
    void close();
    void restartAfterStop();
    void expectAllThere();
    void expectGoodSave(bool isClosed);
    void settle();

    std::mt19937 random_;
    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite";
    FaultyDisk disk_;
    ManualClock clock_;
    Account account_;
    base::JobSystem jobs_{0};
    world::World world_;
    std::unique_ptr<RecordingStore> store_;  // null: not open yet
    std::unique_ptr<stream::ChunkPipeline> pipeline_;
    world::ChunkPos place_;
    bool storesGenerated_ = false;
    bool isPowerLoss_ = false;
    std::optional<stream::Time> toldAt_;  // when the status last had a problem
    SimulationCounts counts_;
};

}  // namespace terrane::store
