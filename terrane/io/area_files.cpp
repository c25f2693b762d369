#include "terrane/io/area_files.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "terrane/base/npy.h"

namespace terrane::io {

namespace {

constexpr const char* kQuadType =
    "[('chunk_x','<i4'),('chunk_y','<i4'),('x','|u1'),('y','|u1'),('z','|u1'),('shape_face','<u2'),"
    "('extent_u','|u1'),('extent_v','|u1'),('material','<u2'),('context','|u1'),('group','|u1')]";
constexpr const char* kTallQuadType =
    "[('chunk_x','<i4'),('chunk_y','<i4'),('x','|u1'),('y','|u1'),('z','<i2'),('shape_face','<u2'),"
    "('extent_u','|u1'),('extent_v','|u1'),('material','<u2'),('context','|u1'),('group','|u1')]";

// What a quad is in besides its chunk.
struct QuadPlace {
    int base = 0;  // z that the quad's counts from
    int bucket = 0, direction = 0;
    bool isTall = false;  // see kTallQuadType
};

void appendQuad(std::string& data, world::ChunkPos pos, shared::Quad quad, const QuadPlace& place) {
    const auto number = [&](auto value) {
        char bytes[sizeof(value)];
        std::memcpy(bytes, &value, sizeof(value));
        data.append(bytes, sizeof(value));
    };
    const auto byte = [&](shared::uint value) { data.push_back(static_cast<char>(value)); };
    number(pos.x);
    number(pos.y);
    byte(shared::quadX(quad));
    byte(shared::quadY(quad));
    const int z = place.base + static_cast<int>(shared::quadZ(quad));
    if (place.isTall)
        number(static_cast<std::int16_t>(z));
    else
        number(static_cast<std::uint8_t>(z));
    number(static_cast<std::uint16_t>(shared::quadShapeFace(quad)));
    byte(shared::quadExtentU(quad));
    byte(shared::quadExtentV(quad));
    number(static_cast<std::uint16_t>(shared::quadMaterial(quad)));
    for (const int value : {place.bucket, place.direction}) byte(static_cast<shared::uint>(value));
}

}  // namespace

QuadFile::QuadFile(base::OutputFile file, const char* type)
    : file_(std::move(file)),
      type_(type),
      headerBytes_(base::npyHeader(type, {SIZE_MAX}).size()),
      sizeBytes_(headerBytes_) {}

base::Result<QuadFile> QuadFile::create(const std::filesystem::path& path, world::Heights heights) {
    auto file = TERRANE_TRY(base::OutputFile::create(path));
    return QuadFile(std::move(file), heights == world::Heights() ? kQuadType : kTallQuadType);
}

base::Result<void> QuadFile::append(world::ChunkPos pos, mesh::ChunkMesh& mesh) {
    std::string data;
    QuadPlace place{.isTall = type_ == kTallQuadType};
    for (const mesh::MeshSection& meshSection : mesh.meshSections) {
        place.base = mesh::quadBase(meshSection);
        for (int bucket = 0; bucket < mesh::kDrawBucketCount; ++bucket) {
            for (int direction = 0; direction < mesh::kFaceDirectionCount; ++direction) {
                const mesh::QuadRange range = meshSection.ranges[bucket][direction];
                const auto quads = std::span(mesh.quads).subspan(range.first, range.count);
                std::ranges::sort(quads, {}, [](shared::Quad q) { return std::pair(q.word0, q.word1); });
                place.bucket = bucket;
                place.direction = direction;
                for (const shared::Quad quad : quads) appendQuad(data, pos, quad, place);
            }
        }
    }
    TERRANE_TRY(file_.write(sizeBytes_, data));
    sizeBytes_ += data.size();
    quadCount_ += mesh.quads.size();
    return {};
}

base::Result<void> QuadFile::finish() {
    const auto written = file_.write(0, base::npyHeader(type_, {quadCount_}, headerBytes_));
    return written ? file_.finish() : written;
}

namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

std::uint64_t columnBytes(world::Heights heights) {
    return static_cast<std::uint64_t>(heights.layers()) * sizeof(std::uint16_t);
}

std::size_t blocksOver(std::int32_t first, std::int32_t end) {
    return static_cast<std::size_t>(std::int64_t{end} - first) * world::kChunkSize;
}

}  // namespace

base::Result<VolumeFile> VolumeFile::create(const std::filesystem::path& path, const world::ChunkArea& area,
                                            world::Heights heights) {
    const std::uint64_t chunkBytes = world::kBlocksPerLayer * columnBytes(heights);
    // One chunk less, for the header.
    if (area.chunkCount() > static_cast<std::int64_t>(INT64_MAX / chunkBytes) - 1)
        return base::fail("{} chunks are too many for a file", area.chunkCount());
    const std::string header =
        base::npyHeader("<u2", {blocksOver(area.x0, area.x1), blocksOver(area.y0, area.y1),
                                static_cast<std::size_t>(heights.layers())});
    auto file = TERRANE_TRY(base::OutputFile::create(path));
    const std::uint64_t sizeBytes =
        header.size() + static_cast<std::uint64_t>(area.chunkCount()) * chunkBytes;
    TERRANE_TRY(file.reserve(sizeBytes));
    TERRANE_TRY(file.write(0, header));
    return VolumeFile(std::move(file), area, heights, header.size());
}

// The columns of one x are contiguous in the file.
base::Result<void> VolumeFile::write(const world::ChunkArea& square, const ColumnOf& columnOf) {
    const std::size_t sizeX = blocksOver(square.x0, square.x1), sizeY = blocksOver(square.y0, square.y1);
    const std::size_t areaSizeY = blocksOver(area_.y0, area_.y1);
    const std::size_t firstX = blocksOver(area_.x0, square.x0), firstY = blocksOver(area_.y0, square.y0);
    const auto layers = static_cast<std::size_t>(heights_.layers());
    std::vector<std::uint16_t> values(sizeY * layers);
    for (std::size_t x = 0; x < sizeX; ++x) {
        for (std::size_t y = 0; y < sizeY; ++y) {
            columnOf(static_cast<int>(x), static_cast<int>(y), std::span(values).subspan(y * layers, layers));
        }
        const std::uint64_t offset =
            headerBytes_ + ((firstX + x) * areaSizeY + firstY) * columnBytes(heights_);
        const std::string_view bytes(reinterpret_cast<const char*>(values.data()),
                                     values.size() * sizeof(std::uint16_t));
        TERRANE_TRY(file_.write(offset, bytes));
    }
    return {};
}

}  // namespace terrane::io
