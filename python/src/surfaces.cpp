// World.heights, surface.
#include <bit>

#include "python/src/arrays.h"
#include "python/src/errors.h"
#include "python/src/world.h"

namespace py = pybind11;

namespace terrane::python {
namespace {

int levelOfStep(int step) {
    if (step < 1 || step > 1 << world::kMaxLevel || !std::has_single_bit(static_cast<unsigned>(step)))
        throw Failure(
            {base::ErrorCode::BadInput,
             fmt::format("step: expected a power of two from 1 to {}, got {}", 1 << world::kMaxLevel, step)});
    return std::countr_zero(static_cast<unsigned>(step));
}

volume::ColumnArea columnsFrom(const py::sequence& where, int step) {
    const auto [x0, y0, x1, y1] = fourNumbers(where, "area");
    return valueOr(volume::columnsOver(levelOfStep(step), x0, y0, x1, y1));
}

// `member` selects the array to read.
template <class T>
py::array_t<T> readColumns(const PyWorld& self, const volume::ColumnArea& area, bool isGround,
                           std::span<T> volume::SurfaceArrays::*member) {
    const auto world = self.opened();
    auto values = zeros<T>({area.y1 - area.y0, area.x1 - area.x0});
    volume::SurfaceArrays arrays;
    arrays.*member = {values.mutable_data(), static_cast<std::size_t>(values.size())};
    const auto layer = isGround ? volume::SurfaceLayer::Ground : volume::SurfaceLayer::Top;
    withoutLock([&] { return volume::readSurfaces(*world, area, layer, arrays, untilInterrupted()); });
    return values;
}

}  // namespace

void addSurfaceMethods(WorldClass& world) {
    world
        .def(
            "heights",
            [](const PyWorld& self, const py::sequence& area, int step, bool ground) {
                return readColumns(self, columnsFrom(area, step), ground, &volume::SurfaceArrays::heights);
            },
            py::arg("area"), py::arg("step") = 1, py::kw_only(), py::arg("ground") = false,
            R"(The z of the topmost block of each column: int16 [y, x], -1 if there is none.

area: (x0, y0, x1, y1) in blocks, the end excluded. step: blocks from one column to the next, a power of two up to
32,768: columns are those of a level of detail, and the area is widened to multiples of the step. ground: ignores
water and trees; trees in water count as water. Plants without collision never count. At
most 2^28 columns.)")
        .def(
            "surface",
            [](const PyWorld& self, const py::sequence& area, int step, bool ground) {
                return readColumns(self, columnsFrom(area, step), ground, &volume::SurfaceArrays::blocks);
            },
            py::arg("area"), py::arg("step") = 1, py::kw_only(), py::arg("ground") = false,
            "The ids of the blocks at the heights of heights(): uint16 [y, x], 0 (air) if there is none.");
}

}  // namespace terrane::python
