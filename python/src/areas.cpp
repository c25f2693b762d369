// World.blocks, states, chunk, chunks, light, digest.
#include <algorithm>

#include "python/src/arrays.h"
#include "python/src/errors.h"
#include "python/src/world.h"
#include "terrane/volume/areas.h"

namespace py = pybind11;

namespace terrane::python {
namespace {

using BlockArray = py::array_t<world::BlockId>;

constexpr py::ssize_t kChunkSide = world::kChunkSize;

std::int64_t maxChunksInArray(world::Heights heights) {
    return volume::kMaxAreaBlocks / (std::int64_t{world::kBlocksPerLayer} * heights.layers());
}

using ReadArea = base::Result<void>(volume::OpenedWorld&, const volume::BlockArea&, std::span<std::uint16_t>,
                                    const volume::ShouldContinue&);

py::array_t<std::uint16_t> readArea(const PyWorld& self, const Arguments& arguments, ReadArea& read) {
    const auto world = self.opened();
    const volume::BlockArea area = areaFrom(arguments["area"], world->heights());
    auto array = zeros<std::uint16_t>({area.height(), area.depth(), area.width()});
    withoutLock([&, values = valuesOf(array)] { return read(*world, area, values, untilInterrupted()); });
    return array;
}

py::array_t<std::uint8_t> readLight(const PyWorld& self, const Arguments& arguments) {
    const auto world = self.opened();
    const volume::BlockArea area = areaFrom(arguments["area"], world->heights());
    auto light = zeros<std::uint8_t>({area.height(), area.depth(), area.width(), volume::kChannelCount});
    static_assert(sizeof(volume::LightLevels) == volume::kChannelCount);
    const std::span levels(reinterpret_cast<volume::LightLevels*>(light.mutable_data()),
                           static_cast<std::size_t>(area.blockCount()));
    withoutLock([&] { return volume::readLight(*world, area, levels, untilInterrupted()); });
    return light;
}

std::uint8_t levelFrom(const Argument& argument) {
    return static_cast<std::uint8_t>(integerFrom(argument, 0, world::kMaxLevel));
}

// x and y are from kMinChunk to kMaxChunk.
world::ChunkPos chunkPos(std::int64_t x, std::int64_t y, std::uint8_t level) {
    const world::ChunkPos pos{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), level};
    if (!world::isInWorld(pos))
        throw Failure({base::ErrorCode::BadInput,
                       fmt::format("chunk {},{} of level {}: outside the world", x, y, level)});
    return pos;
}

BlockArray readChunk(const PyWorld& self, const Arguments& arguments) {
    const auto along = [&](const char* axis) {
        return integerFrom(arguments[axis], world::kMinChunk, world::kMaxChunk);
    };
    const world::ChunkPos pos = chunkPos(along("cx"), along("cy"), levelFrom(arguments["level"]));
    const auto world = self.opened();
    auto blocks = zeros<world::BlockId>({world->heights().layers(), kChunkSide, kChunkSide});
    withoutLock([&, values = valuesOf(blocks)] {
        return volume::readChunkArrays(*world, std::span(&pos, 1), values, untilInterrupted());
    });
    return blocks;
}

std::vector<world::ChunkPos> chunksFrom(const Argument& positions, std::uint8_t level, std::int64_t most) {
    constexpr const char* kExpected = "integers of shape (n, 2)";
    const py::array array = integerArrayFrom(positions, kExpected);
    if (array.ndim() != 2 || array.shape(1) != 2) refuse(positions, kExpected);
    if (array.shape(0) > most)
        throw Failure({base::ErrorCode::BadInput,
                       fmt::format("positions: {} chunks are more than {}", array.shape(0), most)});
    const auto n = elementsOf<std::int32_t>(positions, array, world::kMinChunk, world::kMaxChunk);
    std::vector<world::ChunkPos> chunks;
    for (std::size_t k = 0; k < n.size(); k += 2) chunks.push_back(chunkPos(n[k], n[k + 1], level));
    return chunks;
}

BlockArray readChunks(const PyWorld& self, const Arguments& arguments) {
    const auto world = self.opened();
    const world::Heights heights = world->heights();
    const auto chunks =
        chunksFrom(arguments["positions"], levelFrom(arguments["level"]), maxChunksInArray(heights));
    auto blocks = zeros<world::BlockId>(
        {static_cast<py::ssize_t>(chunks.size()), heights.layers(), kChunkSide, kChunkSide});
    withoutLock([&, values = valuesOf(blocks)] {
        return volume::readChunkArrays(*world, chunks, values, untilInterrupted());
    });
    return blocks;
}

std::string digest(const PyWorld& self, const Arguments& arguments) {
    const auto [x0, y0, x1, y1] = rectangleFrom(arguments["chunks"]);
    if (std::min(x0, y0) < world::kMinChunk || std::max(x1, y1) > world::kMaxChunk + 1 || x0 >= x1 ||
        y0 >= y1)
        refuse(arguments["chunks"], fmt::format("x0 < x1 and y0 < y1 from {} to {}", world::kMinChunk,
                                                std::int64_t{world::kMaxChunk} + 1));
    const auto edge = [](std::int64_t value) { return static_cast<std::int32_t>(value); };
    const world::ChunkArea area{edge(x0), edge(y0), edge(x1), edge(y1)};
    const auto world = self.opened();
    return withoutLock([&] { return volume::digestOf(*world, area, untilInterrupted()); });
}

}  // namespace

void addAreaMethods(WorldClass& world) {
    addMethod(
        world, "blocks(self, area)",
        [](const PyWorld& self, const Arguments& given) { return readArea(self, given, volume::readBlocks); },
        R"(The ids of blocks: uint16 [z, y, x].

area: (x0, y0, z0, x1, y1, z1), or (x0, y0, x1, y1) for the full height, in blocks, the end excluded. The block
at x, y, z is blocks[z - z0, y - y0, x - x0]. At most 2^30 blocks.)");
    addMethod(
        world, "states(self, area)",
        [](const PyWorld& self, const Arguments& given) { return readArea(self, given, volume::readStates); },
        R"(The states of blocks: uint16 [z, y, x], 0 for blocks without one.

area: as of blocks(). The bits of a state are those of the block's type, for example the direction of stairs, whether a
door is open, or the level of a liquid.)");
    addMethod(world, "chunk(self, cx, cy, level=0)", &readChunk,
              R"(The blocks of one chunk: uint16 [top - bottom, 16, 16] by z, y, x.

cx, cy: in chunks of the level. A chunk of level k has 16 by 16 columns, each 2^k blocks wide; level: 0 to 15.)");
    addMethod(
        world, "chunks(self, positions, level=0)", &readChunks,
        R"(The blocks of many chunks, made in parallel: uint16 [n, top - bottom, 16, 16] by chunk, z, y, x.

positions: (n, 2) integers, cx and cy of each; at most 2^22 layers of chunks, 16,384 chunks 256 high.)");
    addMethod(world, "light(self, area)", &readLight,
              R"(Light levels: uint8 [z, y, x, 4], each 0 to 15: sun, red, green, blue.

area: as of blocks(). Sun is the share of daylight that reaches a block, whatever the time of day. At most 2^30
blocks.)");
    addMethod(world, "digest(self, chunks)", &digest,
              R"(The digest that "terrane generate --digest" prints of these chunks: 32 hexadecimal digits.

chunks: (cx0, cy0, cx1, cy1) in chunks, the end excluded.)");
}

}  // namespace terrane::python
