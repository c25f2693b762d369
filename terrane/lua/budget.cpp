#include "terrane/lua/budget.h"

#include <algorithm>
#include <cstdlib>

#include "terrane/base/machine.h"
#include "terrane/lua/lua_headers.h"

namespace terrane::lua {

namespace {

constexpr std::int64_t kStepsBetweenClocks = 2'000;  // some 10 µs
constexpr std::int64_t kStepsOfBlock = 10;           // a call of malloc
constexpr std::int64_t kBytesOfStep = 64;            // written in the time of an instruction
// Lua collects all garbage where memory is refused, and asks again. 64 MiB count as all steps of a script, so
// that steps and not the clock end one that lives at its limit.
constexpr std::int64_t kCollectedBytesOfStep = 16;
constexpr int kLevelsOfPlace = 4;           // a function of C++ calls no deeper
constexpr std::size_t kTextHeadBytes = 32;  // Lua's header of a text, 24 bytes, and the zero behind it

// Sanitizers make everything slower, which is not the script's fault.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kSlowness = 10;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr int kSlowness = 10;
#else
constexpr int kSlowness = 1;
#endif
#else
constexpr int kSlowness = 1;
#endif

}  // namespace

ScriptPlace placeOf(lua_State* L, int maxLevels) {
    lua_Debug frame;
    for (int level = 0; L != nullptr && level < maxLevels && lua_getstack(L, level, &frame) != 0; ++level) {
        lua_getinfo(L, "Sl", &frame);
        if (frame.currentline > 0) return {frame.short_src[1], frame.currentline};
    }
    return {};
}

Budget::Budget(const Limits& limits) : limits_(limits), start_(base::threadTime()) {}

void Budget::refill() {
    spent_ = Spent::Nothing;
    steps_ = stepsAtClock_ = 0;
    start_ = base::threadTime();
    place_ = {};
}

bool Budget::charge(std::int64_t steps) {
    return spend(steps, kStepsBetweenClocks);
}

bool Budget::chargeAndReadClock(std::int64_t steps) {
    return spend(steps, 0);
}

bool Budget::spend(std::int64_t steps, std::int64_t stepsBetweenClocks) {
    steps_ += steps;
    if (spent_ != Spent::Nothing) return false;
    if (steps_ > limits_.steps) {
        spent_ = Spent::Steps;
    } else if (steps_ >= stepsAtClock_ + stepsBetweenClocks) {
        stepsAtClock_ = steps_;
        if (base::threadTime() - start_ > limits_.time * kSlowness) spent_ = Spent::Time;
    }
    if (spent_ == Spent::Nothing) return true;
    place_ = placeOf(state_, kLevelsOfPlace);
    return false;
}

void Budget::pauseClock() {
    pausedAt_ = base::threadTime();
}

void Budget::resumeClock() {
    start_ += base::threadTime() - pausedAt_;
}

bool Budget::allows(std::size_t oldBytes, std::size_t newBytes, std::size_t mostBytes) {
    const auto written = static_cast<std::int64_t>(std::min(newBytes, limits_.memoryBytes));
    if (!charge(kStepsOfBlock + written / kBytesOfStep)) return false;
    if (newBytes <= mostBytes && bytes_ - oldBytes + newBytes <= limits_.memoryBytes) return true;
    place_ = placeOf(state_, kLevelsOfPlace);
    steps_ += static_cast<std::int64_t>(bytes_) / kCollectedBytesOfStep;
    if (steps_ > limits_.steps) spent_ = Spent::Memory;
    return false;
}

void* Budget::allocate(void* budget, void* block, std::size_t oldBytes, std::size_t newBytes) {
    auto& self = *static_cast<Budget*>(budget);
    std::size_t mostBytes = self.limits_.blockBytes;
    if (block == nullptr) {
        // Lua passes the kind of value that a new block is for.
        if (oldBytes == LUA_TSTRING) mostBytes = self.limits_.textBytes + kTextHeadBytes;
        oldBytes = 0;
    }
    if (newBytes == 0) {
        std::free(block);
        self.bytes_ -= oldBytes;
        return nullptr;
    }
    // Lua relies on it that blocks can always become smaller.
    if (newBytes > oldBytes && !self.allows(oldBytes, newBytes, mostBytes)) return nullptr;
    void* moved = std::realloc(block, newBytes);
    if (moved == nullptr) return nullptr;
    self.bytes_ = self.bytes_ - oldBytes + newBytes;
    self.peakBytes_ = std::max(self.peakBytes_, self.bytes_);
    return moved;
}

}  // namespace terrane::lua
