#include "apps/terrane/dump/quad_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <string>

#include "terrane/base/npy.h"

namespace terrane::app {
namespace {

constexpr const char* kQuadType =
    "[('chunk_x','<i4'),('chunk_y','<i4'),('x','|u1'),('y','|u1'),('z','|u1'),('shape_face','<u2'),"
    "('extent_u','|u1'),('extent_v','|u1'),('material','<u2'),('context','|u1'),('group','|u1')]";

void appendQuad(std::string& data, world::ChunkPos pos, shared::Quad quad,
                std::array<int, 2> bucketAndDirection) {
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
    byte(shared::quadZ(quad));
    number(static_cast<std::uint16_t>(shared::quadShapeFace(quad)));
    byte(shared::quadExtentU(quad));
    byte(shared::quadExtentV(quad));
    number(static_cast<std::uint16_t>(shared::quadMaterial(quad)));
    for (const int value : bucketAndDirection) byte(static_cast<shared::uint>(value));
}

}  // namespace

QuadFile::QuadFile(base::OutputFile file)
    : file_(std::move(file)),
      headerBytes_(base::npyHeader(kQuadType, {SIZE_MAX}).size()),
      sizeBytes_(headerBytes_) {}

base::Result<QuadFile> QuadFile::create(const std::filesystem::path& path) {
    auto file = TERRANE_TRY(base::OutputFile::create(path));
    return QuadFile(std::move(file));
}

base::Result<void> QuadFile::append(world::ChunkPos pos, mesh::ChunkMesh& mesh) {
    std::string data;
    for (const mesh::MeshSection& meshSection : mesh.meshSections) {
        for (int bucket = 0; bucket < mesh::kDrawBucketCount; ++bucket) {
            for (int direction = 0; direction < mesh::kFaceDirectionCount; ++direction) {
                const mesh::QuadRange range = meshSection.ranges[bucket][direction];
                const auto quads = std::span(mesh.quads).subspan(range.first, range.count);
                std::ranges::sort(quads, {}, [](shared::Quad q) { return std::pair(q.word0, q.word1); });
                for (const shared::Quad quad : quads) appendQuad(data, pos, quad, {bucket, direction});
            }
        }
    }
    TERRANE_TRY(file_.write(sizeBytes_, data));
    sizeBytes_ += data.size();
    quadCount_ += mesh.quads.size();
    return {};
}

base::Result<void> QuadFile::finish() {
    const auto written = file_.write(0, base::npyHeader(kQuadType, {quadCount_}, headerBytes_));
    return written ? file_.finish() : written;
}

}  // namespace terrane::app
