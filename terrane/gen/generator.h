// A generator ready to run for one world seed: position in, chunk out. The blocks depend on nothing but the
// generator, the seed and the position: not on threads, order of requests or instruction set.
//
// What neighbours may need of a chunk is computed once and kept, in a cache of bounded size; what they do not
// is computed with the chunk itself.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "terrane/gen/generator_graph.h"
#include "terrane/world/chunk.h"
#include "terrane/world/coords.h"

namespace terrane::gen {

class Generator {
  public:
    // `cacheBytes`: for what chunks' neighbours need of them, 1 KiB a field and, where they read blocks,
    // 128 KiB a 3D pass. Overworld: 15 KiB a chunk, so that the default holds 4,350 chunks.
    Generator(GeneratorGraph graph, std::uint64_t seed, std::size_t cacheBytes = std::size_t{64} << 20);
    ~Generator();
    Generator(Generator&&) noexcept;
    Generator& operator=(Generator&&) noexcept;

    // Any thread, any number at a time. `pos` must be in the world. Beyond its edge generation sees
    // coordinates wrap.
    world::Chunk generate(world::ChunkPos pos) const;

    const std::string& name() const;
    std::size_t cacheBytes() const;  // in use

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::gen
