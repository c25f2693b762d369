// A generator at every level: chunks of any level of detail from one seed. It is used by code that streams
// tiles.
//
// The graph of a level and its Generator are made on the first request for the level: a world without far
// tiles does not pay for them. Any thread may use it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "terrane/base/result.h"
#include "terrane/gen/generator.h"
#include "terrane/world/tint.h"

namespace terrane::gen {

class LevelGenerators {
  public:
    // Records the graph of one level, such as makeGenerator(name, blocks, {level, heights}). Called at most
    // twice a level, for its blocks and for its tint, by one thread at a time, later too: objects that it
    // refers to live as long as this object.
    using MakeGraph = std::function<base::Result<GeneratorGraph>(int level)>;

    // `heights`: of the world, for which all graphs are recorded.
    LevelGenerators(MakeGraph makeGraph, std::uint64_t seed, world::Heights heights = {});
    ~LevelGenerators();
    LevelGenerators(LevelGenerators&&) noexcept;
    LevelGenerators& operator=(LevelGenerators&&) noexcept;

    world::Heights heights() const;

    // Returns the generator of a level, 0…world::kMaxLevel, which lives as long as this object; or the error
    // of its graph.
    [[nodiscard]] base::Result<const Generator*> at(int level) const;

    // Returns the chunk of the position's level. Throws std::invalid_argument with the reason if there is
    // none.
    [[nodiscard]] world::Chunk generate(world::ChunkPos pos) const;

    // Returns whether the generator has a tint at level 0. The first call records that level's graph.
    [[nodiscard]] bool hasTint() const;
    // Returns the tint of the chunk's columns; none if its level or level 0 has none. It generates no blocks.
    // Errors are those of generate().
    [[nodiscard]] std::optional<world::TintTile> tint(world::ChunkPos pos) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::gen
