// World.set_blocks.
#include "python/src/arrays.h"
#include "python/src/errors.h"
#include "python/src/world.h"
#include "terrane/volume/areas.h"

namespace py = pybind11;

namespace terrane::python {
namespace {

using Values16 = py::array_t<std::uint16_t, py::array::c_style>;

// The values of an argument, one or an array [z, y, x] of them, and the memory that they lie in.
struct GivenValues {
    std::vector<std::int64_t> sides;  // of the array; empty: one value
    std::vector<std::uint16_t> own;
    Values16 array;  // used instead if it has the library's layout

    std::span<const std::uint16_t> span() const {
        return own.empty() ? std::span(array.data(), static_cast<std::size_t>(array.size())) : std::span(own);
    }
};

bool hasLayout(const py::array& array) {
    return Values16::check_(array) &&
           (py::detail::array_proxy(array.ptr())->flags & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
}

GivenValues valuesFrom(const Argument& argument, const char* expected) {
    if (isInteger(argument.value))
        return {
            .sides = {}, .own = {static_cast<std::uint16_t>(integerFrom(argument, 0, 0xFFFF))}, .array = {}};
    const py::array array = integerArrayFrom(argument, expected);
    if (array.ndim() != 3 || array.size() == 0) refuse(argument, expected);
    GivenValues values{.sides = {array.shape(0), array.shape(1), array.shape(2)}, .own = {}, .array = {}};
    if (hasLayout(array))
        values.array = Values16(array);
    else
        values.own = elementsOf<std::uint16_t>(argument, array, 0, 0xFFFF);
    return values;
}

GivenValues blocksFrom(const PyWorld& self, const Argument& argument) {
    if (!py::isinstance<py::str>(argument.value))
        return valuesFrom(argument, "a block id, a name or an array of block ids [z, y, x]");
    return {.sides = {}, .own = {blockId(self, textFrom(argument))}, .array = {}};
}

// None: no states.
std::optional<GivenValues> statesFrom(const Argument& argument, const GivenValues& blocks) {
    if (argument.value.is_none()) return std::nullopt;
    constexpr const char* kExpected = "a block state or an array of them in the shape of blocks";
    auto states = valuesFrom(argument, kExpected);
    if (!states.sides.empty() && states.sides != blocks.sides) refuse(argument, kExpected);
    return states;
}

volume::BlockArea boxFrom(const Arguments& arguments, const std::vector<std::int64_t>& sides,
                          world::Heights heights) {
    constexpr std::int64_t kLow = INT32_MIN, kHigh = INT32_MAX;
    const std::int64_t x = integerFrom(arguments["x"], kLow, kHigh),
                       y = integerFrom(arguments["y"], kLow, kHigh),
                       z = integerFrom(arguments["z"], heights.bottom, heights.top - 1);
    const auto side = [&](std::size_t axis) { return sides.empty() ? std::int64_t{1} : sides[axis]; };
    const volume::BlockArea area{x, y, z, x + side(2), y + side(1), z + side(0)};
    valueOr(volume::checkArea(area, heights));
    return area;
}

std::int64_t setBlocks(const PyWorld& self, const Arguments& arguments) {
    const GivenValues blocks = blocksFrom(self, arguments["blocks"]);
    const auto states = statesFrom(arguments["states"], blocks);
    const volume::BlockArea area = boxFrom(arguments, blocks.sides, self.opened()->heights());
    volume::BlockValues values{blocks.span()};
    if (states) values.states = states->span();
    const auto world = self.opened();
    return withoutLock([&] { return volume::writeArea(*world, area, values, untilInterrupted()); });
}

}  // namespace

void addEditMethods(WorldClass& world) {
    addMethod(world, "set_blocks(self, x, y, z, blocks, states=None)", &setBlocks,
              R"(Sets blocks from x, y, z on, and returns the number of changed blocks.

blocks: an id, the name of a block, or an array of ids [z, y, x] (uint16 is not copied). states: None, one for all
blocks, or an array [z, y, x] in the shape of blocks. Without states, a block that changes gets state 0. Exactly
these blocks are set: sand does not fall. A saved world has them on disk after flush() or close() at the latest. An
unknown id is an error, and nothing changes.)");
}

}  // namespace terrane::python
