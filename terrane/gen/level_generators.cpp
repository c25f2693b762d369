#include "terrane/gen/level_generators.h"

#include <array>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "terrane/gen/language/builder.h"

namespace terrane::gen {

struct LevelGenerators::Impl {
    Impl(MakeGraph make, std::uint64_t s, world::Heights h)
        : makeGraph(std::move(make)), seed(s), heights(h) {}

    base::Result<GeneratorGraph> record(int level) const;

    MakeGraph makeGraph;
    std::uint64_t seed;
    world::Heights heights;
    std::mutex mutex;
    // Never changed once set: threads use them without the lock.
    std::array<std::optional<base::Result<Generator>>, world::kMaxLevel + 1> generators;
    struct Tint {
        Generator generator;
        std::uint32_t field;
    };
    // Set for the levels requested so far; a level may have no tint.
    std::array<std::optional<base::Result<std::optional<Tint>>>, world::kMaxLevel + 1> tints;
    base::Result<std::optional<Tint>> makeTint(int level);

    // Null if the level has none.
    const Tint* tint(int level);
    base::Result<std::optional<Tint>>& madeTint(int level);  // under the mutex
};

base::Result<GeneratorGraph> LevelGenerators::Impl::record(int level) const {
    auto graph = makeGraph(level);
    if (graph && graph->heights != heights) {
        return base::fail("generator \"{}\" was recorded for layers {}, its world has {}", graph->name,
                          world::describe(graph->heights), world::describe(heights));
    }
    return graph;
}

LevelGenerators::LevelGenerators(MakeGraph makeGraph, std::uint64_t seed, world::Heights heights)
    : impl_(std::make_unique<Impl>(std::move(makeGraph), seed, heights)) {}
LevelGenerators::~LevelGenerators() = default;
LevelGenerators::LevelGenerators(LevelGenerators&&) noexcept = default;
LevelGenerators& LevelGenerators::operator=(LevelGenerators&&) noexcept = default;

world::Heights LevelGenerators::heights() const {
    return impl_->heights;
}

base::Result<const Generator*> LevelGenerators::at(int level) const {
    if (level < 0 || level > world::kMaxLevel) {
        return base::fail("level {} is not in 0…{}", level, world::kMaxLevel);
    }
    const std::lock_guard lock(impl_->mutex);
    auto& generator = impl_->generators[static_cast<std::size_t>(level)];
    if (!generator) {
        auto graph = impl_->record(level);
        if (graph) {
            generator.emplace(Generator(*std::move(graph), impl_->seed));
        } else {
            generator.emplace(tl::unexpected(std::move(graph.error())));
        }
    }
    if (!*generator) return tl::unexpected(generator->error());
    return &**generator;
}

base::Result<std::optional<LevelGenerators::Impl::Tint>>& LevelGenerators::Impl::madeTint(int level) {
    auto& made = tints[static_cast<std::size_t>(level)];
    if (!made) made.emplace(makeTint(level));
    return *made;
}

// A level has a tint only if level 0 has one.
const LevelGenerators::Impl::Tint* LevelGenerators::Impl::tint(int level) {
    const std::lock_guard lock(mutex);
    if (const auto& lowest = madeTint(0); lowest && !*lowest) return nullptr;
    const auto& made = madeTint(level);
    if (!made) throw std::invalid_argument(made.error().message);
    return *made ? &**made : nullptr;
}

base::Result<std::optional<LevelGenerators::Impl::Tint>> LevelGenerators::Impl::makeTint(int level) {
    const auto graph = TERRANE_TRY(record(level));
    if (!graph.tint) return std::nullopt;
    return Tint{Generator(graph.tint->passes, seed), graph.tint->field};
}

bool LevelGenerators::hasTint() const {
    const std::lock_guard lock(impl_->mutex);
    const auto& lowest = impl_->madeTint(0);
    return lowest && *lowest;
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
