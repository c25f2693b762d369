#include "terrane/light/light_sources.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

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
    const Section::Value first = property(section.palette()[0]);
    if (std::all_of(mapped.begin(), end, [&](auto value) { return value == first; }))
        return pool.uniform(first);
    Brick* brick = pool.acquire();
    section.unpackMapped(std::span(mapped.begin(), end), valuesOf(*brick));
    return {brick->values.data(), brick->values.data(), false};
}

bool areAll(const DaylightColumns& columns, LightValue value) {
    return std::all_of(columns.begin(), columns.end(), [&](LightValue v) { return v == value; });
}

// Emission of the section and the daylight that reaches it straight from above.
BrickView sourcesOf(BrickView emission, BrickView opacity, Daylight& daylight, BrickPool& pool) {
    DaylightColumns& columns = daylight.columns;
    if (daylight.isDark()) return emission;
    const bool isClear = opacity.isUniform && opacity.uniformValue() == allComponents(0);
    if (isClear && emission.isUniform && daylight.isEven)
        return pool.uniform(static_cast<LightValue>(emission.uniformValue() | columns[0]));
    if (opacity.isUniform && opacity.uniformValue() == allComponents(kMaxLevel)) {
        columns.fill(kDark);
        daylight.isEven = true;
        return emission;
    }
    LightValue* light = emission.writable ? emission.writable : pool.acquire()->values.data();
    propagateSunlight(opacity.values, emission.values, columns, light);
    daylight.isEven = areAll(columns, columns[0]);
    return {light, light, false};
}

bool areSame(const BrickView& a, const BrickView& b) {
    return a.isUniform && b.isUniform && a.uniformValue() == b.uniformValue();
}

ChunkBricks findBricks(const world::Chunk& chunk, const LightTable& table, BrickPool& pool,
                       bool isSunlitOnly) {
    ChunkBricks bricks;
    Daylight daylight;
    const Section* above = nullptr;
    for (int number = chunk.heights().endSection() - 1; number >= chunk.heights().firstSection(); --number) {
        if (isSunlitOnly && daylight.isDark()) break;
        const Section& section = chunk.section(number);
        // Two equal sections of one kind of block have the same light if daylight passes the upper one as it
        // is; no others of them need to be read.
        if (above && section.isUniform() && section.isSame(*above) && bricks.back().light.isUniform) {
            bricks.back().lowest = number;
            continue;
        }
        above = &section;
        const BrickView opacity = opacityOf(section, table, pool);
        const BrickView light = sourcesOf(emissionOf(section, table, pool), opacity, daylight, pool);
        if (!bricks.empty() && areSame(light, bricks.back().light) &&
            areSame(opacity, bricks.back().opacity)) {
            bricks.back().lowest = number;
        } else {
            bricks.push_back({number, number, light, opacity});
        }
    }
    return bricks;
}

}  // namespace

BrickView opacityOf(const Section& section, const LightTable& table, BrickPool& pool) {
    return brickOf(section, pool, [&](world::BlockId id) { return table.opacity(id); });
}

BrickView emissionOf(const Section& section, const LightTable& table, BrickPool& pool) {
    return brickOf(section, pool, [&](world::BlockId id) { return table.emission(id); });
}

ChunkBricks findSources(const world::Chunk& chunk, const LightTable& table, BrickPool& pool) {
    return findBricks(chunk, table, pool, false);
}

ChunkBricks findSunlitSources(const world::Chunk& chunk, const LightTable& table, BrickPool& pool) {
    return findBricks(chunk, table, pool, true);
}

OpenSections::OpenSections(const LightTable& table) : table_(table) {}

bool OpenSections::isOpen(const world::Section& section) {
    const BrickView opacity = opacityOf(section, table_, pool_);
    const std::span<const LightValue> values(opacity.values,
                                             opacity.isUniform ? 1 : world::kBlocksPerSection);
    const bool isClear = std::ranges::all_of(values, [](LightValue v) { return v == allComponents(0); });
    const bool isHigh = std::exchange(isClearAbove_, isClear) && isClear;
    const bool isSunlit = !daylight_.isDark();
    if (isSunlit) sourcesOf(emissionOf(section, table_, pool_), opacity, daylight_, pool_);
    pool_.reset();
    return isSunlit || isHigh;
}

int lowestOpenSection(const world::Chunk& chunk, const LightTable& table) {
    OpenSections sections(table);
    int lowest = chunk.heights().endSection();
    for (int number = lowest - 1; number >= chunk.lowestMade(); --number)
        if (sections.isOpen(chunk.section(number))) lowest = number;
    return lowest;
}

}  // namespace terrane::light
