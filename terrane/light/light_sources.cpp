#include "terrane/light/light_sources.h"

#include <algorithm>
#include <cassert>

#include "terrane/light/kernels_internal.h"

namespace terrane::light {

LightTable::LightTable(const world::BlockRegistry& blocks) : missing_(blocks.missing()) {
    for (const world::BlockType& type : blocks.types()) {
        LightValue emission = kDark;
        for (int c = kRed; c <= kBlue; ++c) {
            const int level = type.emission[static_cast<std::size_t>(c)];
            assert(level <= kMaxLevel && "the registry checks levels");
            emission = withLevel(emission, c, level);
        }
        entries_.push_back({allComponents(type.opacity), emission});
    }
}

namespace {

using world::Section;

std::span<LightValue, world::kBlocksPerSection> valuesOf(Brick& brick) {
    return brick.values;
}

// A property of all blocks of a section: a uniform brick if it has one value, else a brick of values.
template <class Property>
BrickView brickOf(const Section& section, BrickPool& pool, Property property) {
    if (section.isUniform()) return pool.uniform(property(section.uniformValue()));
    if (section.isDense()) {
        Brick* brick = pool.acquire();
        section.unpack(valuesOf(*brick));
        for (LightValue& value : brick->values) value = property(value);
        return {brick->values.data(), brick->values.data(), false};
    }
    std::array<Section::Value, 256> mapped;  // a palette has at most 256 entries
    const auto end =
        std::transform(section.palette().begin(), section.palette().end(), mapped.begin(), property);
    if (std::all_of(mapped.begin(), end, [&](auto value) { return value == mapped[0]; }))
        return pool.uniform(mapped[0]);
    Brick* brick = pool.acquire();
    section.unpackMapped(std::span(mapped.begin(), end), valuesOf(*brick));
    return {brick->values.data(), brick->values.data(), false};
}

bool areAll(const DaylightColumns& columns, LightValue value) {
    return std::all_of(columns.begin(), columns.end(), [&](LightValue v) { return v == value; });
}

// Emission of the section and the daylight that reaches it straight from above.
BrickView sourcesOf(BrickView emission, BrickView opacity, DaylightColumns& columns, BrickPool& pool) {
    if (areAll(columns, kDark)) return emission;
    const bool isClear = opacity.isUniform && opacity.uniformValue() == allComponents(0);
    if (isClear && emission.isUniform && areAll(columns, columns[0]))
        return pool.uniform(static_cast<LightValue>(emission.uniformValue() | columns[0]));
    if (opacity.isUniform && opacity.uniformValue() == allComponents(kMaxLevel)) {
        columns.fill(kDark);
        return emission;
    }
    LightValue* light = emission.writable ? emission.writable : pool.acquire()->values.data();
    propagateSunlight(opacity.values, emission.values, columns, light);
    return {light, light, false};
}

}  // namespace

ChunkBricks findSources(const world::Chunk& chunk, const LightTable& table, BrickPool& pool, int lowest) {
    ChunkBricks bricks;
    DaylightColumns columns;
    columns.fill(kFullDaylight);
    for (int number = world::kSectionsPerChunk - 1; number >= lowest; --number) {
        const auto k = static_cast<std::size_t>(number);
        const Section& section = chunk.section(number);
        bricks.opacity[k] = brickOf(section, pool, [&](world::BlockId id) { return table.opacity(id); });
        const BrickView emission =
            brickOf(section, pool, [&](world::BlockId id) { return table.emission(id); });
        bricks.light[k] = sourcesOf(emission, bricks.opacity[k], columns, pool);
    }
    return bricks;
}

}  // namespace terrane::light
