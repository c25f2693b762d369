// A generator ready to run for one world seed: position in, chunk out. The blocks depend on nothing but the
// generator, the seed and the position: not on threads, order of requests or instruction set.
//
// Each pass of each chunk is computed once and kept while neighbours may need it, in a cache of bounded size.
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
    // `cachedChunks`: how many chunks' intermediate results are kept; each takes 1 KiB a field and 128 KiB
    // for each 3D pass but the last (overworld: about 150 KiB).
    Generator(GeneratorGraph graph, std::uint64_t seed, std::size_t cachedChunks = 1280);
    ~Generator();
    Generator(Generator&&) noexcept;
    Generator& operator=(Generator&&) noexcept;

    // Any thread, any number at a time. `pos` must be in the world. Beyond its edge generation sees
    // coordinates wrap.
    world::Chunk generate(world::ChunkPos pos) const;

    const std::string& name() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::gen
