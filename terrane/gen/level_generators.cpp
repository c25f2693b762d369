#include "terrane/gen/level_generators.h"

#include <array>
#include <mutex>
#include <optional>
#include <stdexcept>

namespace terrane::gen {

struct LevelGenerators::Impl {
    Impl(MakeGraph make, std::uint64_t s) : makeGraph(std::move(make)), seed(s) {}

    MakeGraph makeGraph;
    std::uint64_t seed;
    std::mutex mutex;
    // Never changed once set: threads use them without the lock.
    std::array<std::optional<base::Result<Generator>>, world::kMaxLevel + 1> generators;
};

LevelGenerators::LevelGenerators(MakeGraph makeGraph, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(std::move(makeGraph), seed)) {}
LevelGenerators::~LevelGenerators() = default;
LevelGenerators::LevelGenerators(LevelGenerators&&) noexcept = default;
LevelGenerators& LevelGenerators::operator=(LevelGenerators&&) noexcept = default;

base::Result<const Generator*> LevelGenerators::at(int level) const {
    if (level < 0 || level > world::kMaxLevel) {
        return base::fail("level {} is not in 0…{}", level, world::kMaxLevel);
    }
    const std::lock_guard lock(impl_->mutex);
    auto& generator = impl_->generators[static_cast<std::size_t>(level)];
    if (!generator) {
        auto graph = impl_->makeGraph(level);
        if (graph) {
            generator.emplace(Generator(*std::move(graph), impl_->seed));
        } else {
            generator.emplace(tl::unexpected(std::move(graph.error())));
        }
    }
    if (!*generator) return tl::unexpected(generator->error());
    return &**generator;
}

world::Chunk LevelGenerators::generate(world::ChunkPos pos) const {
    const auto generator = at(pos.level);
    if (!generator) throw std::invalid_argument(generator.error().message);
    return (*generator)->generate(pos);
}

}  // namespace terrane::gen
