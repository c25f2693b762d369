// Counts the steps, time and memory of a running script, and reports which limit it exceeded. One thread uses
// it.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

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

// A line of a script. `file` is its letter in names of chunks (sandbox.h).
struct ScriptPlace {
    char file = 0;
    int line = 0;  // 0: none
};

// Returns the place of the innermost function of a script; none while C++ alone runs.
ScriptPlace placeOf(lua_State* L, int maxLevels);

class Budget {
  public:
    enum class Spent : std::uint8_t { Nothing, Steps, Time, Memory };

    explicit Budget(const Limits& limits);

    const Limits& limits() const { return limits_; }
    // Gives the script its steps and its time again: it runs anew, with the memory that it still holds.
    void refill();

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

    // Sets the state whose place place() gives.
    void watch(lua_State* state) { state_ = state; }
    // Returns the place in the script where a limit was met, if one ran. Steps and time come before memory.
    ScriptPlace place() const { return place_; }

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
    ScriptPlace place_;
};

}  // namespace terrane::lua
