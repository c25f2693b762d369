// Helpers for benchmarks: the block types that come with the program, exit on errors.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "terrane/base/result.h"
#include "terrane/content/built_in.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::bench {

template <class T>
T orExit(base::Result<T> result) {
    if (result) return std::move(*result);
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::exit(1);
}

inline void orExit(const base::Result<void>& result) {
    if (!result) static_cast<void>(orExit(base::Result<int>(tl::unexpected(result.error()))));
}

inline const world::BlockRegistry& blocks() {
    static const world::BlockRegistry registry = orExit(content::loadBlocks());
    return registry;
}

inline world::BlockId blockId(std::string_view name) {
    return blocks().find(name)->id;
}

}  // namespace terrane::bench
