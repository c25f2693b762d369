// Counts the steps, time and memory of a running script, and says which limit it met. One thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "terrane/lua/limits_internal.h"

struct lua_State;

namespace terrane::lua {

class Budget {
  public:
    enum class Spent : std::uint8_t { Nothing, Steps, Time, Memory };

    explicit Budget(const Limits& limits);

    // Returns false once a limit is used up. Reads the clock after every 2,000 steps.
    bool charge(std::int64_t steps);
    // The same, and reads the clock in any case.
    bool chargeAndReadClock(std::int64_t steps);
    // Stops counting the thread's time until the next call of resumeClock, for work that a process does once.
    void pauseClock();
    void resumeClock();
    Spent spent() const { return spent_; }
    std::int64_t steps() const { return steps_; }
    std::size_t peakBytes() const { return peakBytes_; }

    // Sets the state whose line line() gives.
    void watch(lua_State* state) { state_ = state; }
    // The script's line where a limit was met, 0 if none ran. Steps and time come before memory.
    int line() const { return line_; }

    // A lua_Alloc whose first argument is a Budget. Returns null beyond the limits; then Lua ends the script.
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

}  // namespace terrane::lua
