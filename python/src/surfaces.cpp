// World.heights, surface, biomes, biome_names.
#include <pybind11/stl.h>

#include <bit>

#include "python/src/arrays.h"
#include "python/src/errors.h"
#include "python/src/world.h"

namespace py = pybind11;

namespace terrane::python {
namespace {

int levelOfStep(const Argument& step) {
    constexpr std::int64_t kMaxStep = std::int64_t{1} << world::kMaxLevel;
    const auto blocks = static_cast<std::uint64_t>(integerFrom(step, 1, kMaxStep));
    if (!std::has_single_bit(blocks)) refuse(step, fmt::format("a power of two from 1 to {}", kMaxStep));
    return std::countr_zero(blocks);
}

volume::ColumnArea columnsFrom(const Arguments& arguments) {
    const auto [x0, y0, x1, y1] = rectangleFrom(arguments["area"]);
    return valueOr(volume::columnsOver(levelOfStep(arguments["step"]), x0, y0, x1, y1));
}

template <class T>
py::array_t<T> columnArray(const volume::ColumnArea& area) {
    return zeros<T>({area.y1 - area.y0, area.x1 - area.x0});
}

// `member` selects the array to read.
template <class T>
py::array_t<T> readColumns(const PyWorld& self, const Arguments& arguments,
                           std::span<T> volume::SurfaceArrays::*member) {
    const volume::ColumnArea area = columnsFrom(arguments);
    const auto layer =
        boolFrom(arguments["ground"]) ? volume::SurfaceLayer::Ground : volume::SurfaceLayer::Top;
    const auto world = self.opened();
    auto values = columnArray<T>(area);
    volume::SurfaceArrays arrays;
    arrays.*member = valuesOf(values);
    withoutLock([&] { return volume::readSurfaces(*world, area, layer, arrays, untilInterrupted()); });
    return values;
}

py::array_t<std::uint8_t> readBiomes(const PyWorld& self, const Arguments& arguments) {
    const volume::ColumnArea area = columnsFrom(arguments);
    const auto world = self.opened();
    auto biomes = columnArray<std::uint8_t>(area);
    withoutLock([&, values = valuesOf(biomes)] {
        return volume::readBiomes(*world, area, values, untilInterrupted());
    });
    return biomes;
}

std::vector<std::string> biomeNames(const PyWorld& self) {
    const gen::Biomes* biomes = self.opened()->biomes();
    if (biomes == nullptr) return {};
    const auto names = biomes->names();
    return {names.begin(), names.end()};
}

}  // namespace

void addSurfaceMethods(WorldClass& world) {
    addMethod(
        world, "heights(self, area, step=1, *, ground=False)",
        [](const PyWorld& self, const Arguments& given) {
            return readColumns(self, given, &volume::SurfaceArrays::heights);
        },
        R"(The z of the topmost block of each column: int16 [y, x], bottom - 1 if there is none.

area: (x0, y0, x1, y1) in blocks, the end excluded. step: blocks from one column to the next, a power of two up to
32,768: columns are those of a level of detail, and the area is widened to multiples of the step. ground: ignores
water and trees; trees in water count as water. Plants without collision never count. At
most 2^28 columns.)");
    addMethod(
        world, "surface(self, area, step=1, *, ground=False)",
        [](const PyWorld& self, const Arguments& given) {
            return readColumns(self, given, &volume::SurfaceArrays::blocks);
        },
        "The ids of the blocks at the heights of heights(): uint16 [y, x], 0 (air) if there is none.");
    addMethod(world, "biomes(self, area, step=1)", &readBiomes,
              R"(The biome of each column: uint8 [y, x], an index of biome_names.

area, step: as of heights(). Edits do not change biomes. Raises Error unsupported if the generator has no biomes:
"continents" and "wilderness" have them.)");
    addProperty(
        world, "biome_names", &biomeNames,
        "list[str]: the names of the generator's biomes; the index is the number. Empty if it has none.");
}

}  // namespace terrane::python
