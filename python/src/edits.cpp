// World.set_blocks.
#include "python/src/arrays.h"
#include "python/src/errors.h"
#include "python/src/world.h"
#include "terrane/volume/areas.h"

namespace py = pybind11;

namespace terrane::python {
namespace {

using Ids = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

volume::BlockArea boxAt(std::int64_t x, std::int64_t y, std::int64_t z, const py::array& blocks) {
    if (blocks.ndim() != 0 && blocks.ndim() != 3)
        throw Failure(
            {base::ErrorCode::BadInput,
             fmt::format("blocks: expected an id or an array [z, y, x], got {} dimensions", blocks.ndim())});
    constexpr std::int64_t kFar = std::int64_t{1} << 40;  // sums cannot overflow
    if (std::min({x, y, z}) < -kFar || std::max({x, y, z}) > kFar)
        throw Failure({base::ErrorCode::BadInput, fmt::format("{},{},{}: outside the world", x, y, z)});
    const auto side = [&](int axis) { return blocks.ndim() == 0 ? py::ssize_t{1} : blocks.shape(axis); };
    const volume::BlockArea area{x, y, z, x + side(2), y + side(1), z + side(0)};
    valueOr(volume::checkArea(area));
    return area;
}

// Ids of any integer type; refuses values that do not fit uint16.
std::vector<world::BlockId> narrowed(const py::array& blocks) {
    if (blocks.dtype().kind() != 'i' && blocks.dtype().kind() != 'u')
        throw Failure({base::ErrorCode::BadInput, "blocks: expected integers"});
    const Ids wide(blocks);
    std::vector<world::BlockId> ids(static_cast<std::size_t>(wide.size()));
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const std::int64_t id = wide.data()[k];
        if (id < 0 || id > 0xFFFF)
            throw Failure({base::ErrorCode::BadInput, fmt::format("block id {}: expected 0 to 65535", id)});
        ids[k] = static_cast<world::BlockId>(id);
    }
    return ids;
}

std::int64_t write(const PyWorld& self, const volume::BlockArea& area,
                   std::span<const world::BlockId> blocks) {
    const auto world = self.opened();
    return withoutLock([&] { return volume::writeArea(*world, area, {blocks}, untilInterrupted()); });
}

std::int64_t setBlocks(const PyWorld& self, std::int64_t x, std::int64_t y, std::int64_t z,
                       const py::object& blocks) {
    if (py::isinstance<py::str>(blocks)) {
        const auto name = blocks.cast<std::string>();
        const world::BlockType* type = self.opened()->blocks().find(name);
        if (type == nullptr)
            throw Failure({base::ErrorCode::NotFound, fmt::format("\"{}\" is no block", name)});
        return write(self, boxAt(x, y, z, py::array(py::int_(0))), std::span(&type->id, 1));
    }
    const py::array array = py::array::ensure(blocks);
    if (!array) throw py::error_already_set();
    const volume::BlockArea area = boxAt(x, y, z, array);
    // Without a copy if the array has the library's layout.
    if (py::isinstance<py::array_t<world::BlockId, py::array::c_style>>(array)) {
        const auto values = py::array_t<world::BlockId, py::array::c_style>::ensure(array);
        return write(self, area, {values.data(), static_cast<std::size_t>(values.size())});
    }
    return write(self, area, narrowed(array));
}

}  // namespace

void addEditMethods(WorldClass& world) {
    world.def("set_blocks", &setBlocks, py::arg("x"), py::arg("y"), py::arg("z"), py::arg("blocks"),
              R"(Sets blocks from x, y, z on, and returns the number of changed blocks.

blocks: an id, the name of a block, or an array of ids [z, y, x] (uint16 is not copied). Exactly these blocks are
set: sand does not fall. A saved world has them on disk after flush() or close() at the latest. An unknown id is an
error, and nothing changes.)");
}

}  // namespace terrane::python
