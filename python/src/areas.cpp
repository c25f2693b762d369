// World.blocks, chunk, chunks, light, digest.
#include <algorithm>

#include "python/src/arrays.h"
#include "python/src/errors.h"
#include "python/src/world.h"
#include "terrane/volume/areas.h"

namespace py = pybind11;

namespace terrane::python {
namespace {

using BlockArray = py::array_t<world::BlockId>;
using Positions = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

constexpr py::ssize_t kChunkSide = world::kChunkSize, kHeight = world::kChunkHeight;
constexpr std::int64_t kMaxChunksInArray = volume::kMaxAreaBlocks / world::kBlocksPerChunk;

template <class T>
std::span<T> valuesOf(py::array_t<T>& array) {
    return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

BlockArray readBlocks(const PyWorld& self, const py::sequence& where) {
    const volume::BlockArea area = areaFrom(where);
    const auto world = self.opened();
    auto blocks = zeros<world::BlockId>({area.height(), area.depth(), area.width()});
    withoutLock([&, values = valuesOf(blocks)] {
        return volume::readBlocks(*world, area, values, untilInterrupted());
    });
    return blocks;
}

py::array_t<std::uint8_t> readLight(const PyWorld& self, const py::sequence& where) {
    const volume::BlockArea area = areaFrom(where);
    const auto world = self.opened();
    auto light = zeros<std::uint8_t>({area.height(), area.depth(), area.width(), volume::kChannelCount});
    static_assert(sizeof(volume::LightLevels) == volume::kChannelCount);
    const std::span levels(reinterpret_cast<volume::LightLevels*>(light.mutable_data()),
                           static_cast<std::size_t>(area.blockCount()));
    withoutLock([&] { return volume::readLight(*world, area, levels, untilInterrupted()); });
    return light;
}

world::ChunkPos chunkPos(std::int64_t x, std::int64_t y, int level) {
    const bool isChunk = level >= 0 && level <= world::kMaxLevel && std::min(x, y) >= world::kMinChunk &&
                         std::max(x, y) <= world::kMaxChunk;
    const world::ChunkPos pos{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
                              static_cast<std::uint8_t>(level)};
    if (!isChunk || !world::isInWorld(pos))
        throw Failure({base::ErrorCode::BadInput,
                       fmt::format("chunk {},{} of level {}: outside the world", x, y, level)});
    return pos;
}

BlockArray readChunk(const PyWorld& self, std::int64_t x, std::int64_t y, int level) {
    const world::ChunkPos pos = chunkPos(x, y, level);
    const auto world = self.opened();
    auto blocks = zeros<world::BlockId>({kHeight, kChunkSide, kChunkSide});
    withoutLock([&, values = valuesOf(blocks)] {
        return volume::readChunkArrays(*world, std::span(&pos, 1), values, untilInterrupted());
    });
    return blocks;
}

BlockArray readChunks(const PyWorld& self, const Positions& positions, int level) {
    if (positions.ndim() != 2 || positions.shape(1) != 2)
        throw Failure({base::ErrorCode::BadInput, "positions: expected an array of shape (n, 2)"});
    const py::ssize_t count = positions.shape(0);
    if (count > kMaxChunksInArray)
        throw Failure({base::ErrorCode::BadInput,
                       fmt::format("positions: {} chunks are more than {}", count, kMaxChunksInArray)});
    std::vector<world::ChunkPos> chunks;
    for (py::ssize_t k = 0; k < count; ++k)
        chunks.push_back(chunkPos(positions.at(k, 0), positions.at(k, 1), level));
    const auto world = self.opened();
    auto blocks = zeros<world::BlockId>({count, kHeight, kChunkSide, kChunkSide});
    withoutLock([&, values = valuesOf(blocks)] {
        return volume::readChunkArrays(*world, chunks, values, untilInterrupted());
    });
    return blocks;
}

std::string digest(const PyWorld& self, const py::sequence& where) {
    const auto [x0, y0, x1, y1] = fourNumbers(where, "chunks");
    if (x0 >= x1 || y0 >= y1)
        throw Failure({base::ErrorCode::BadInput, "chunks: expected x0 < x1 and y0 < y1"});
    const world::ChunkPos first = chunkPos(x0, y0, 0), last = chunkPos(x1 - 1, y1 - 1, 0);
    const auto world = self.opened();
    return withoutLock([&] {
        return volume::digestOf(*world, {first.x, first.y, last.x + 1, last.y + 1}, untilInterrupted());
    });
}

}  // namespace

void addAreaMethods(WorldClass& world) {
    world
        .def("blocks", &readBlocks, py::arg("area"),
             R"(The ids of blocks: uint16 [z, y, x].

area: (x0, y0, z0, x1, y1, z1), or (x0, y0, x1, y1) for the full height, in blocks, the end excluded. The block
at x, y, z is blocks[z - z0, y - y0, x - x0]. At most 2^30 blocks.)")
        .def("chunk", &readChunk, py::arg("cx"), py::arg("cy"), py::arg("level") = 0,
             R"(The blocks of one chunk: uint16 [256, 16, 16] by z, y, x.

cx, cy: in chunks of the level. A chunk of level k has 16 by 16 columns, each 2^k blocks wide; level: 0 to 15.)")
        .def("chunks", &readChunks, py::arg("positions"), py::arg("level") = 0,
             R"(The blocks of many chunks, made in parallel: uint16 [n, 256, 16, 16] by chunk, z, y, x.

positions: (n, 2) integers, cx and cy of each; at most 16,384 chunks.)")
        .def("light", &readLight, py::arg("area"),
             R"(Light levels: uint8 [z, y, x, 4], each 0 to 15: sun, red, green, blue.

area: as of blocks(). Sun is the share of daylight that reaches a block, whatever the time of day. At most 2^30
blocks.)")
        .def("digest", &digest, py::arg("chunks"),
             R"(The digest that "terrane generate --digest" prints of these chunks: 32 hexadecimal digits.

chunks: (cx0, cy0, cx1, cy1) in chunks, the end excluded.)");
}

}  // namespace terrane::python
