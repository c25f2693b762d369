#include "terrane/mesh/face_writer.h"

#include <algorithm>
#include <cassert>

namespace terrane::mesh {
namespace {

using shared::packQuad;
using shared::Quad;
using shared::uint;

// Where coordinates lie in a quad's first word (shared/quad.h).
constexpr unsigned kShiftX = 0, kShiftY = 4, kShiftZ = 8, kShiftU = 24, kShiftV = 28;

}  // namespace

// One plane of faces: what is equal in its quads, and where a rectangle's bit and row belong in them.
struct FaceWriter::Plane {
    Quad first;  // a quad of one face at bit 0, row 0
    unsigned bitShift, rowShift;
    Merge merge;
};

void FaceWriter::write(const BitCube& faces, const FaceKind& kind) {
    assert(kind.material < materials_.size() && "material of the registry the blocks are from");
    assert(kind.plane < world::kFaceCount && "planes lie along a side");
    const world::Material& material = materials_[kind.material];
    bucket_ = &out_.bucket(faceContext(material), faceGroup(kind.shapeFace, material));
    isAlongZ(kind.plane) ? writeLevel(faces, kind) : writeUpright(faces, kind);
}

void FaceWriter::writeLevel(const BitCube& faces, const FaceKind& kind) {
    for (std::size_t layer = 0; layer < 16; ++layer) {
        const std::uint64_t* words = &faces[4 * layer];
        if ((words[0] | words[1] | words[2] | words[3]) == 0) continue;
        BitSlice rows;
        for (std::size_t row = 0; row < 16; ++row) rows[row] = cubeRow(faces, layer, row);
        const uint z = static_cast<uint>(baseZ_) + static_cast<uint>(layer);
        const Quad first =
            packQuad({.x = 0, .y = 0, .z = z, .shapeFace = kind.shapeFace, .material = kind.material});
        writePlane(rows, {first, kShiftX, kShiftY, kind.merge});
        out_.coverHeight(static_cast<int>(z), static_cast<int>(z) + 1);
    }
}

void FaceWriter::writeUpright(const BitCube& faces, const FaceKind& kind) {
    std::array<std::uint64_t, 4> used{};  // all layers on top of each other: which planes have faces
    for (std::size_t i = 0; i < faces.size(); i += 4) {
        for (std::size_t k = 0; k < 4; ++k) used[k] |= faces[i + k];
    }
    const bool alongX = isAlongX(kind.plane);
    for (std::size_t plane = 0; plane < 16; ++plane) {
        if (static_cast<std::uint16_t>(used[plane / 4] >> (16 * (plane % 4))) == 0) continue;
        BitSlice rows;
        for (std::size_t layer = 0; layer < 16; ++layer) rows[layer] = cubeRow(faces, layer, plane);
        const auto at = static_cast<uint>(plane);
        const Quad first = packQuad({.x = alongX ? at : 0,
                                     .y = alongX ? 0 : at,
                                     .z = static_cast<uint>(baseZ_),
                                     .shapeFace = kind.shapeFace,
                                     .material = kind.material});
        const auto [firstRow, endRow] =
            writePlane(rows, {first, alongX ? kShiftY : kShiftX, kShiftZ, kind.merge});
        out_.coverHeight(baseZ_ + firstRow, baseZ_ + endRow);
    }
}

// Returns which rows have faces: from the first, up to the second.
std::pair<int, int> FaceWriter::writePlane(const BitSlice& rows, const Plane& plane) {
    const std::span<const Rectangle> rectangles = mergeRows(rows, plane.merge, rectangles_);
    assert(!rectangles.empty() && "planes without faces are passed over");
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
