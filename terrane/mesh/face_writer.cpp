#include "terrane/mesh/face_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>

#include "terrane/mesh/bit_kernels.h"
#include "terrane/shared/merge_passes.h"

namespace terrane::mesh {

namespace {

using shared::Quad;
using shared::uint;

constexpr unsigned kShiftU = 24, kShiftV = 28;  // of a quad's extents, shared/quad.h

Quad quadAt(const QuadPattern& pattern, uint bit, uint row, uint bits, uint rows) {
    return {pattern.first.word0 + (bit << pattern.bitShift) + (row << pattern.rowShift) +
                ((bits - 1) << kShiftU) + ((rows - 1) << kShiftV),
            pattern.first.word1};
}

// Index of the lowest set bit; `value` is not 0. std::countr_zero would test for 0.
uint lowestOne(uint value) {
    return static_cast<uint>(__builtin_ctz(value));
}

constexpr uint kNoBit = 1u << 17;  // no row of 16 bits has it

// kStep is that of the plane: a compile-time constant saves multiplications (15 % of meshing a landscape).
// The word of a quad is summed up as its rectangle grows.
template <std::size_t kStep>
std::size_t mergeGreedily(const PlaneRows& plane, const QuadPattern& pattern, Quad* out) {
    const Quad* begin = out;
    // Extents are stored less one; since the end of a run is added, a higher first bit makes the run shorter.
    const uint oneBit = (1u << pattern.bitShift) - (1u << kShiftU);
    const uint origin = pattern.first.word0 - (1u << kShiftU);
    for (uint used = plane.used; used != 0; used &= used - 1) {
        const uint row = lowestOne(used), rowOrigin = origin + (row << pattern.rowShift);
        std::uint16_t* const rows = plane.rows + row * kStep;
        uint left = *rows;
        do {
            // Adding the lowest bit carries through the set bits above it: the bits that the carry clears are
            // the run.
            const uint lowest = left & (0u - left), carried = left + lowest, run = left & ~carried;
            left ^= run;
            uint word0 = rowOrigin + (lowestOne(carried) << kShiftU) + lowestOne(lowest) * oneBit;
            // A row whose bits go on beyond both ends of the run would be cut in three, so it begins a new
            // rectangle.
            const uint before = lowest > 1 ? lowest >> 1 : kNoBit, sides = before | (run + lowest);
            std::uint16_t* next = rows + kStep;
            for (uint nextRow = 2u << row; (used & nextRow) != 0; nextRow <<= 1, next += kStep) {
                const uint bits = *next;
                if ((bits & run) != run || (bits & sides) == sides) break;
                *next = static_cast<std::uint16_t>(bits ^ run);
                used &= ~(bits == run ? nextRow : 0);
                word0 += 1u << kShiftV;
            }
            *out++ = {word0, pattern.first.word1};
        } while (left != 0);
    }
    return static_cast<std::size_t>(out - begin);
}

std::size_t mergeGreedy(const PlaneRows& plane, const QuadPattern& pattern, Quad* out) {
    assert((plane.step == 1 || plane.step == 16) && "a plane of a cube");
    return plane.step == 1 ? mergeGreedily<1>(plane, pattern, out) : mergeGreedily<16>(plane, pattern, out);
}

std::size_t mergeNothing(const PlaneRows& plane, const QuadPattern& pattern, Quad* out) {
    const Quad* begin = out;
    for (uint used = plane.used; used != 0; used &= used - 1) {
        const uint row = lowestOne(used);
        for (uint left = plane.rows[row * plane.step]; left != 0; left &= left - 1) {
            *out++ = quadAt(pattern, lowestOne(left), row, 1, 1);
        }
    }
    return static_cast<std::size_t>(out - begin);
}

// The methods of the thesis start with one rectangle a bit and merge neighbors pass by pass.

// Sizes of the rectangles along one axis by the cell of their lowest corner, bit + 16 row; 0 where none
// begins.
using Sizes = std::array<std::uint8_t, 256>;

// kStride: distance of neighboring cells along the axis of the pass; a compile-time constant saves divisions.
template <unsigned kStride>
void join(Sizes& along, Sizes& across, uint pass) {
    const uint lines = shared::mergeLines(pass), length = shared::mergeLength(pass);
    for (unsigned cell = 0; cell < 256; ++cell) {
        if (along[cell] == 0) continue;
        const unsigned first = cell / kStride % 16;
        for (;;) {
            const unsigned end = first + along[cell], next = cell + along[cell] * kStride;
            if (end == 16 || (lines >> end & 1) == 0 || across[next] != across[cell]) break;
            if (length != 0 && along[cell] != length) break;
            along[cell] = static_cast<std::uint8_t>(along[cell] + along[next]);
            along[next] = across[next] = 0;
        }
    }
}

template <MergeMethod kMethod>
std::size_t mergeInPasses(const PlaneRows& plane, const QuadPattern& pattern, Quad* out) {
    Sizes bits{}, rows{};
    for (unsigned cell = 0; cell < 256; ++cell) {
        if ((plane.used >> cell / 16 & 1) == 0) continue;
        bits[cell] = rows[cell] =
            static_cast<std::uint8_t>(plane.rows[cell / 16 * plane.step] >> cell % 16 & 1);
    }
    constexpr auto kNumber = static_cast<uint>(kMethod);
    constexpr uint kFirst = shared::firstMergePass(kNumber), kEnd = shared::endOfMergePasses(kNumber);
    for (uint pass = kFirst; pass < kEnd; pass += 2) {
        join<1>(bits, rows, pass);
        join<16>(rows, bits, pass + 1);
    }
    const Quad* begin = out;
    for (unsigned cell = 0; cell < 256; ++cell) {
        if (bits[cell] != 0) *out++ = quadAt(pattern, cell % 16, cell / 16, bits[cell], rows[cell]);
    }
    return static_cast<std::size_t>(out - begin);
}

static_assert(static_cast<uint>(MergeMethod::None) == shared::kMergeNone &&
              static_cast<uint>(MergeMethod::Lines) == shared::kMergeLines &&
              static_cast<uint>(MergeMethod::Squares) == shared::kMergeSquares &&
              static_cast<uint>(MergeMethod::SquaresExt) == shared::kMergeSquaresExt &&
              static_cast<uint>(MergeMethod::Greedy) == shared::kMergeGreedy);

constexpr std::array<MergeFunction, static_cast<std::size_t>(MergeMethod::Count)> kFunctions{
    mergeNothing, mergeInPasses<MergeMethod::Lines>, mergeInPasses<MergeMethod::Squares>,
    mergeInPasses<MergeMethod::SquaresExt>, mergeGreedy};

}  // namespace

MergeFunction mergeFunction(MergeMethod method) {
    assert(method < MergeMethod::Count && "one of the methods");
    return kFunctions[static_cast<std::size_t>(method)];
}

namespace {

using shared::packQuad;

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
        const int z = target_.baseZ + static_cast<int>(layer);
        const Quad first = packQuad({.x = 0,
                                     .y = 0,
                                     .z = shared::quadZOf(z),
                                     .shapeFace = kind.shapeFace,
                                     .material = kind.material});
        const PlaneRows plane{&rows_[16 * layer], 1, used_[layer]};
        bucket_->add(merge(plane, {first, kShiftX, kShiftY}, bucket_->reserve(kMaxQuadsPerPlane)));
        out_.coverHeight(z, z + 1);
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
                                     .z = shared::quadZOf(target_.baseZ),
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
