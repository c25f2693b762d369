#include "terrane/mesh/face_writer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#include "terrane/mesh/bit_kernels.h"

namespace terrane::mesh {
namespace {

using shared::packQuad;
using shared::Quad;
using shared::uint;

// Shifts of the coordinates in a quad's first word (shared/quad.h).
constexpr unsigned kShiftX = 0, kShiftY = 4, kShiftZ = 8;

static_assert(std::endian::native == std::endian::little, "rows are read as parts of words in memory order");

// Bit l of word p: bit p of layer l.
BitSlice acrossLayers(const BitSlice& layers) {
    BitCube cube;
    std::memcpy(cube.data(), layers.data(), sizeof(layers));
    const BitCube turned = transposed(cube, {0, 1});
    BitSlice result;
    std::memcpy(result.data(), turned.data(), sizeof(result));
    return result;
}

}  // namespace

void FaceWriter::write(const BitCube& faces, const FaceKind& kind, LayerRange layers) {
    assert(kind.material < materials_.size() && "material of the registry the blocks are from");
    assert(kind.plane < world::kFaceCount && "planes lie along a side");
    used_ = {};
    usedRows(faces, layers, used_);
    if (used_ == BitSlice{}) return;
    const world::Material& material = materials_[kind.material];
    bucket_ = &out_.quadsOf(drawBucket(material), faceDirection(kind.shapeFace, material));
    std::memcpy(&rows_[16 * layers.first], &faces[4 * layers.first], 32 * (layers.end - layers.first));
    isAlongZ(kind.plane) ? writeLevel(kind, layers) : writeUpright(kind, layers);
}

void FaceWriter::writeLevel(const FaceKind& kind, LayerRange layers) {
    const MergeFunction merge = mergeOf(kind);
    for (std::size_t layer = layers.first; layer < layers.end; ++layer) {
        if (used_[layer] == 0) continue;
        const uint z = static_cast<uint>(target_.baseZ) + static_cast<uint>(layer);
        const Quad first =
            packQuad({.x = 0, .y = 0, .z = z, .shapeFace = kind.shapeFace, .material = kind.material});
        const PlaneRows plane{&rows_[16 * layer], 1, used_[layer]};
        bucket_->add(merge(plane, {first, kShiftX, kShiftY}, bucket_->reserve(kMaxQuadsPerPlane)));
        out_.coverHeight(static_cast<int>(z), static_cast<int>(z) + 1);
    }
}

void FaceWriter::writeUpright(const FaceKind& kind, LayerRange layers) {
    const MergeFunction merge = mergeOf(kind);
    const bool alongX = isAlongX(kind.plane);
    const BitSlice usedLayers = acrossLayers(used_);
    std::size_t lowest = layers.end, end = layers.first;
    for (std::size_t plane = 0; plane < 16; ++plane) {
        const unsigned used = usedLayers[plane];
        if (used == 0) continue;
        const auto at = static_cast<uint>(plane);
        const Quad first = packQuad({.x = alongX ? at : 0,
                                     .y = alongX ? 0 : at,
                                     .z = static_cast<uint>(target_.baseZ),
                                     .shapeFace = kind.shapeFace,
                                     .material = kind.material});
        const QuadPattern pattern{first, alongX ? kShiftY : kShiftX, kShiftZ};
        bucket_->add(merge({&rows_[plane], 16, used}, pattern, bucket_->reserve(kMaxQuadsPerPlane)));
        lowest = std::min(lowest, static_cast<std::size_t>(std::countr_zero(used)));
        end = std::max(end, static_cast<std::size_t>(std::bit_width(used)));
    }
    out_.coverHeight(target_.baseZ + static_cast<int>(lowest), target_.baseZ + static_cast<int>(end));
}

}  // namespace terrane::mesh
