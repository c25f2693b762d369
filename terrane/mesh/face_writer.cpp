#include "terrane/mesh/face_writer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace terrane::mesh {
namespace {

using shared::packQuad;
using shared::Quad;
using shared::uint;

// Where coordinates lie in a quad's first word (shared/quad.h).
constexpr unsigned kShiftX = 0, kShiftY = 4, kShiftZ = 8, kShiftU = 24, kShiftV = 28;

static_assert(std::endian::native == std::endian::little, "rows are read as parts of words in memory order");

// Which rows have bits.
std::uint32_t usedRows(const std::array<std::uint64_t, 4>& words) {
    std::uint32_t used = 0;
    for (std::size_t row = 0; row < 16; ++row) {
        used |= std::uint32_t{static_cast<std::uint16_t>(words[row / 4] >> 16 * (row % 4)) != 0} << row;
    }
    return used;
}

}  // namespace

// One plane of faces: what is equal in its quads, and where a rectangle's bit and row belong in them.
struct FaceWriter::Plane {
    PlaneRows rows;
    Quad first;  // a quad of one face at bit 0, row 0
    unsigned bitShift, rowShift;
    MergeFunction merge;
};

void FaceWriter::write(const BitCube& faces, const FaceKind& kind, LayerRange layers) {
    assert(kind.material < materials_.size() && "material of the registry the blocks are from");
    assert(kind.plane < world::kFaceCount && "planes lie along a side");
    std::array<std::uint64_t, 4> used{};  // all layers on top of each other
    for (std::size_t i = 4 * layers.first; i < 4 * layers.end; ++i) used[i % 4] |= faces[i];
    if ((used[0] | used[1] | used[2] | used[3]) == 0) return;
    const world::Material& material = materials_[kind.material];
    bucket_ = &out_.bucket(faceContext(material), faceGroup(kind.shapeFace, material));
    std::memcpy(&rows_[16 * layers.first], &faces[4 * layers.first], 32 * (layers.end - layers.first));
    isAlongZ(kind.plane) ? writeLevel(kind, layers) : writeUpright(kind, usedRows(used), layers);
}

void FaceWriter::writeLevel(const FaceKind& kind, LayerRange layers) {
    for (std::size_t layer = layers.first; layer < layers.end; ++layer) {
        const uint z = static_cast<uint>(target_.baseZ) + static_cast<uint>(layer);
        const Quad first =
            packQuad({.x = 0, .y = 0, .z = z, .shapeFace = kind.shapeFace, .material = kind.material});
        const auto [firstRow, endRow] =
            writePlane({{&rows_[16 * layer]}, first, kShiftX, kShiftY, mergeOf(kind)});
        if (firstRow < endRow) out_.coverHeight(static_cast<int>(z), static_cast<int>(z) + 1);
    }
}

void FaceWriter::writeUpright(const FaceKind& kind, std::uint32_t planes, LayerRange layers) {
    const auto firstLayer = static_cast<unsigned>(layers.first), endLayer = static_cast<unsigned>(layers.end);
    const bool alongX = isAlongX(kind.plane);
    for (; planes != 0; planes &= planes - 1) {
        const auto at = static_cast<uint>(std::countr_zero(planes));
        const Quad first = packQuad({.x = alongX ? at : 0,
                                     .y = alongX ? 0 : at,
                                     .z = static_cast<uint>(target_.baseZ),
                                     .shapeFace = kind.shapeFace,
                                     .material = kind.material});
        const auto [firstRow, endRow] = writePlane({{&rows_[at], 16, firstLayer, endLayer},
                                                    first,
                                                    alongX ? kShiftY : kShiftX,
                                                    kShiftZ,
                                                    mergeOf(kind)});
        out_.coverHeight(target_.baseZ + firstRow, target_.baseZ + endRow);
    }
}

// Returns which rows have faces: from the first, up to the second.
std::pair<int, int> FaceWriter::writePlane(const Plane& plane) {
    const std::span<const Rectangle> rectangles = plane.merge(plane.rows, rectangles_);
    if (rectangles.empty()) return {0, 0};
    int endRow = 0;
    for (const Rectangle& r : rectangles) {
        Quad quad = plane.first;
        quad.word0 += uint{r.bit} << plane.bitShift | uint{r.row} << plane.rowShift;
        quad.word0 += (r.bits - 1u) << kShiftU | (r.rows - 1u) << kShiftV;
        bucket_->push_back(quad);
        endRow = std::max(endRow, r.row + r.rows);
    }
    return {rectangles.front().row, endRow};
}

}  // namespace terrane::mesh
