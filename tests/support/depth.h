// How deep tests go. `./run test` is the gate: every kind of check, with few seeds, views and variants.
// `./run test all` sets TERRANE_DEPTH=all: many of each.
#pragma once

#include <cstdlib>
#include <string_view>

namespace terrane {

// Read once; anything but "all" is the gate.
inline bool testsAll() {
    static const bool all = [] {
        const char* depth = std::getenv("TERRANE_DEPTH");
        return depth && std::string_view(depth) == "all";
    }();
    return all;
}

// A number of seeds, views or steps at each depth.
template <class T>
T atDepth(T gate, T all) {
    return testsAll() ? all : gate;
}

}  // namespace terrane
