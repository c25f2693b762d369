// Waits for events of other threads, of other programs and of the network.
#pragma once

#include <chrono>
#include <thread>

namespace terrane::base {

// Ends a test that would wait forever. Nothing that is waited for takes nearly as long, so no result depends
// on the speed of the machine.
constexpr std::chrono::minutes kHangs{5};

// Calls `step` until the condition holds. False if the test hangs.
template <class Condition, class Step>
bool waitUntil(Condition isSo, Step step) {
    const auto end = std::chrono::steady_clock::now() + kHangs;
    while (!isSo()) {
        if (std::chrono::steady_clock::now() > end) return false;
        step();
    }
    return true;
}
template <class Condition>
bool waitUntil(Condition isSo) {
    return waitUntil(isSo, [] { std::this_thread::sleep_for(std::chrono::milliseconds(1)); });
}

}  // namespace terrane::base
