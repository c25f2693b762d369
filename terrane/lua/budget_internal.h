// Counts the steps, time and memory of a running script, and reports which limit it exceeded. One thread uses
// it.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "terrane/gen/compile/generator_graph.h"

struct lua_State;

namespace terrane::lua {

// Limits of one run of a script. Steps are counted alike on every machine, so that a script stops at the same
// place everywhere. Time is a second limit, for work that steps do not measure: comparing long strings,
// colliding keys.
// 64 KiB of zeros take 0.9 ms to compare: Lua calls strcoll for each. Between two readings of the clock, 200
// instructions, stand some 45 comparisons.
constexpr std::size_t kMaxTextBytes = std::size_t{64} << 10;

struct Limits {
    std::size_t memoryBytes = std::size_t{64} << 20;
    // The array of a table: 2^18 elements of 16 bytes.
    std::size_t blockBytes = std::size_t{4} << 20;
    std::size_t textBytes = kMaxTextBytes;
    // Instructions of Lua, about 5 ns each. Functions and memory count as the instructions that take as long.
    std::int64_t steps = 4'000'000;
    std::chrono::milliseconds time{100};  // thread time
};

// Limits of the generator that a script records. The larger generators of the program have some 3,000 nodes a
// pass. All passes together have at most 100,000 nodes: Limits::steps / 40, the steps of a node (call.cpp).
constexpr std::size_t kMaxNodesInPass = 20'000;
constexpr std::size_t kMaxPasses = 32;
constexpr std::size_t kMaxFields = 128;
constexpr std::size_t kMaxVariablesInPass = 256;
constexpr std::size_t kMaxSeedNames = 512;  // noises and random numbers: the builder looks through them
constexpr std::size_t kMaxNameBytes = 64;
constexpr std::size_t kMaxDrainages = 4;
constexpr std::size_t kMaxVoxels = 200'000;  // in all shapes together
constexpr std::size_t kMaxLoopDepth = 2;

// Work of the slowest chunk in operations, where each loop runs 1,024 rounds: 65,536 voxels, which are 256
// layers, × 100,000 operations take some 2 s. Chunks of a taller world have more voxels with fewer
// operations.
constexpr double kMaxOperationsOfChunk = 65'536 * 100'000.0;
// Heights of one region of a drainage map: (128 + 2 · 88)² cells with 4 samples each
// (gen/drainage/drainage_curves.cpp). A chunk at a corner needs four regions.
constexpr double kColumnsOfRegion = 369'664;
constexpr double kRegionsOfChunk = 4;
// Rings of chunks around one that are made before it: (2 · 6 + 1)² = 169 chunks.
constexpr int kMaxRings = 6;
// 3D passes whose blocks are kept for neighbors: 8 KiB each for a section that is not one block, for 256
// chunks and more of each level, up to the most memory that gen::CacheSize has.
constexpr std::ptrdiff_t kMaxKeptBlocks = 2;

class Budget {
  public:
    enum class Spent : std::uint8_t { Nothing, Steps, Time, Memory };

    explicit Budget(const Limits& limits);

    // Returns false once a limit is used up. Reads the clock after every 2,000 steps.
    bool charge(std::int64_t steps);
    // Does the same, and reads the clock in any case.
    bool chargeAndReadClock(std::int64_t steps);
    // Stops counting the thread's time until the next call of resumeClock, for work that a process does once.
    void pauseClock();
    void resumeClock();
    Spent spent() const { return spent_; }
    std::int64_t steps() const { return steps_; }
    std::size_t peakBytes() const { return peakBytes_; }

    // Sets the state whose line line() gives.
    void watch(lua_State* state) { state_ = state; }
    // Returns the script's line where a limit was met, 0 if none ran. Steps and time come before memory.
    int line() const { return line_; }

    // Allocates memory for Lua, as a lua_Alloc whose first argument is a Budget. Returns null beyond the
    // limits; then Lua ends the script.
    static void* allocate(void* budget, void* block, std::size_t oldBytes, std::size_t newBytes);

  private:
    bool spend(std::int64_t steps, std::int64_t stepsBetweenClocks);
    bool allows(std::size_t oldBytes, std::size_t newBytes, std::size_t mostBytes);

    Limits limits_;
    Spent spent_ = Spent::Nothing;
    std::int64_t steps_ = 0, stepsAtClock_ = 0;
    std::chrono::nanoseconds start_, pausedAt_{};
    std::size_t bytes_ = 0, peakBytes_ = 0;
    lua_State* state_ = nullptr;
    int line_ = 0;
};

// Bounds the time that a chunk of a recorded generator takes. script.cpp checks each script's. Any thread may
// call it. Returns the reason if a chunk may take too long, else an empty string. The graph has no mistakes.
// Stamps count once it has its table of shapes.
std::string unboundedWork(const gen::GeneratorGraph& graph);

}  // namespace terrane::lua
