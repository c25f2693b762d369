#include "terrane/gen/level_generators.h"

#include <array>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "terrane/gen/tint_graph.h"

namespace terrane::gen {

struct LevelGenerators::Impl {
    Impl(MakeGraph make, std::uint64_t s) : makeGraph(std::move(make)), seed(s) {}

    MakeGraph makeGraph;
    std::uint64_t seed;
    std::mutex mutex;
    // Never changed once set: threads use them without the lock.
    std::array<std::optional<base::Result<Generator>>, world::kMaxLevel + 1> generators;
    struct Tint {
        Generator generator;
        std::uint32_t field;
    };
    std::array<std::optional<Tint>, world::kMaxLevel + 1> tints;
    std::optional<bool> hasTint;  // known with the first graph; the same at all levels

    const Tint* tint(int level);
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
            impl_->hasTint = graph->tint != nullptr;
            generator.emplace(Generator(*std::move(graph), impl_->seed));
        } else {
            generator.emplace(tl::unexpected(std::move(graph.error())));
        }
    }
    if (!*generator) return tl::unexpected(generator->error());
    return &**generator;
}

// Null where there is none.
const LevelGenerators::Impl::Tint* LevelGenerators::Impl::tint(int level) {
    const std::lock_guard lock(mutex);
    auto& made = tints[static_cast<std::size_t>(level)];
    if (made || hasTint == false) return made ? &*made : nullptr;
    const auto graph = makeGraph(level);
    if (!graph) throw std::invalid_argument(graph.error().message);
    hasTint = graph->tint != nullptr;
    if (!graph->tint) return nullptr;
    made.emplace(Tint{Generator(graph->tint->passes, seed), graph->tint->field});
    return &*made;
}

bool LevelGenerators::hasTint() const {
    if (!at(0)) return false;
    const std::lock_guard lock(impl_->mutex);
    return impl_->hasTint.value_or(false);
}

std::optional<world::TintTile> LevelGenerators::tint(world::ChunkPos pos) const {
    if (pos.level > world::kMaxLevel) requireGenerated(pos, world::kMaxLevel);
    const Impl::Tint* tint = impl_->tint(pos.level);
    if (!tint) return std::nullopt;
    world::TintTile tile = tint->generator.columns(pos, tint->field);
    for (world::PackedColor& color : tile) color &= 0xFFFFFFu;
    return tile;
}

world::Chunk LevelGenerators::generate(world::ChunkPos pos) const {
    const auto generator = at(pos.level);
    if (!generator) throw std::invalid_argument(generator.error().message);
    return (*generator)->generate(pos);
}

}  // namespace terrane::gen
