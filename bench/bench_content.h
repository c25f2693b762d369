// What the benchmarks share: the block types that come with the program.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>
#include <utility>

#include "terrane/base/embedded.h"
#include "terrane/base/result.h"
#include "terrane/world/block_registry.h"

namespace terrane::embedded {
std::span<const base::EmbeddedFile> content();
}  // namespace terrane::embedded

namespace terrane::bench {

template <class T>
T orExit(base::Result<T> result) {
    if (result) return std::move(*result);
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::exit(1);
}

inline const world::BlockRegistry& blocks() {
    static const world::BlockRegistry registry = [] {
        std::string_view text;
        for (const base::EmbeddedFile& file : embedded::content()) {
            if (file.path == "blocks.toml") text = file.data;
        }
        return orExit(world::BlockRegistry::parse(text, "blocks.toml"));
    }();
    return registry;
}

inline world::BlockId blockId(std::string_view name) {
    return blocks().find(name)->id;
}

}  // namespace terrane::bench
