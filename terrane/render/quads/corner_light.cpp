#include "terrane/render/quads/corner_light.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "terrane/base/profile.h"

namespace terrane::render {
namespace {

using light::LightValue;

constexpr int kLayerSide = world::kChunkSize + 2;  // blocks of a layer, with one more on each side
constexpr int kMostPoints = world::kChunkSize + 1;

// Components of a mean are counted in these parts of a level.
constexpr int kParts = 12;  // divides by one to four blocks

// The light of a mesh section's blocks and of those around them, unpacked.
class LightBlock {
  public:
    void read(const LightAround& around, int bottom, int top) {
        bottom_ = bottom - 1;
        values_.assign(static_cast<std::size_t>(top - bottom + 2) * kLayerSide * kLayerSide, light::kDark);
        for (int k = 0; k < 9; ++k)
            if (around[static_cast<std::size_t>(k)])
                readChunk(*around[static_cast<std::size_t>(k)], {k % 3 - 1, k / 3 - 1}, top + 1);
    }
    LightValue at(glm::ivec3 block) const { return values_[place(block.x, block.y, block.z)]; }

  private:
    std::size_t place(int x, int y, int z) const {
        return static_cast<std::size_t>(((z - bottom_) * kLayerSide + y + 1) * kLayerSide + x + 1);
    }

    // The part of a chunk `offset` chunks away that lies in the block. Above the world is daylight.
    void readChunk(const light::ChunkLight& chunk, glm::ivec2 offset, int top) {
        const auto from = [](int away) { return away < 0 ? world::kChunkSize - 1 : 0; };
        const auto to = [](int away) { return away > 0 ? 1 : world::kChunkSize; };
        const glm::ivec2 corner = offset * world::kChunkSize;
        const world::Heights heights = chunk.heights();
        for (int z = std::max(bottom_, heights.bottom); z < top;) {
            const bool isAbove = z >= heights.top;
            const light::LightBrick sky(light::kFullDaylight);
            const light::LightBrick& brick = isAbove ? sky : chunk.brick(z >> 4);
            const int end = isAbove ? top : std::min(top, (z | 15) + 1);
            std::array<LightValue, world::kBlocksPerSection> unpacked;
            const bool isWhole = offset == glm::ivec2(0) && !brick.isUniform();
            if (isWhole) brick.unpack(unpacked);
            for (; z < end; ++z) {
                for (int y = from(offset.y); y < to(offset.y); ++y) {
                    const int row = 16 * y + 256 * (z & 15);
                    LightValue* const out = &values_[place(corner.x + from(offset.x), corner.y + y, z)];
                    const int count = to(offset.x) - from(offset.x);
                    if (brick.isUniform()) {
                        std::fill_n(out, count, brick.uniformValue());
                    } else if (isWhole) {
                        std::copy_n(&unpacked[static_cast<std::size_t>(row)], count, out);
                    } else {
                        for (int x = 0; x < count; ++x) out[x] = brick.get(row + from(offset.x) + x);
                    }
                }
            }
        }
    }

    int bottom_ = 0;
    std::vector<LightValue> values_;
};

// Four components in parts of a level.
using Levels = std::array<int, light::kComponentCount>;

LightValue packed(const Levels& levels) {
    LightValue value = light::kDark;
    for (int k = 0; k < light::kComponentCount; ++k)
        value = light::withLevel(value, k, (levels[static_cast<std::size_t>(k)] + kParts / 2) / kParts);
    return value;
}

// A face in its lattice of points: columns along u, rows along v.
struct Lattice {
    int columns = 1, rows = 1;  // blocks
    std::array<Levels, kMostPoints * kMostPoints> points;

    Levels& at(int i, int j) { return points[static_cast<std::size_t>(j * kMostPoints + i)]; }
    const Levels& at(int i, int j) const { return points[static_cast<std::size_t>(j * kMostPoints + i)]; }
};

struct Rectangle {
    int i0, i1, j0, j1;
};

int toleranceOf(int parts) {
    constexpr float kPart = 1.0f / kParts;
    return static_cast<int>(cornerLightTolerance(kPart * static_cast<float>(parts)) * kParts);
}

// Whether light is nearly linear on the two triangles of corners 0 1 2 and 2 1 3.
bool isLinear(const Lattice& lattice, Rectangle r) {
    const Levels &c0 = lattice.at(r.i0, r.j0), &c1 = lattice.at(r.i1, r.j0), &c2 = lattice.at(r.i0, r.j1),
                 &c3 = lattice.at(r.i1, r.j1);
    const int w = r.i1 - r.i0, h = r.j1 - r.j0;
    for (int j = 0; j <= h; ++j) {
        for (int i = 0; i <= w; ++i) {
            const Levels& here = lattice.at(r.i0 + i, r.j0 + j);
            const bool isFirst = i * h + j * w <= w * h;
            for (std::size_t k = 0; k < here.size(); ++k) {
                // Times w·h, so that all are whole numbers.
                const int linear =
                    isFirst ? c0[k] * w * h + (c1[k] - c0[k]) * i * h + (c2[k] - c0[k]) * j * w
                            : c3[k] * w * h + (c2[k] - c3[k]) * (w - i) * h + (c1[k] - c3[k]) * (h - j) * w;
                if (std::abs(here[k] * w * h - linear) > toleranceOf(here[k]) * w * h) return false;
            }
        }
    }
    return true;
}

// Halves the longer side until light is linear.
template <class Use>
void split(const Lattice& lattice, Rectangle r, const Use& use) {
    const int w = r.i1 - r.i0, h = r.j1 - r.j0;
    if ((w == 1 && h == 1) || isLinear(lattice, r)) return use(r);
    Rectangle a = r, b = r;
    if (w >= h) {
        a.i1 = b.i0 = r.i0 + w / 2;
    } else {
        a.j1 = b.j0 = r.j0 + h / 2;
    }
    split(lattice, a, use);
    split(lattice, b, use);
}

int floorOf(float value) {
    return static_cast<int>(std::floor(value));
}

class Lighter {
  public:
    Lighter(const LightAround& around, std::span<const shared::ShapeFace> shapeFaces, Splitting splitting,
            LitMesh& out)
        : around_(around),
          shapeFaces_(shapeFaces),
          splitting_(splitting),
          out_(out),
          isLit_(around[4] != nullptr) {}

    void addMeshSection(const mesh::ChunkMesh& mesh, const mesh::MeshSection& section) {
        if (isLit_) block_.read(around_, section.minZ, section.maxZ);
        base_ = mesh::quadBase(section);
        mesh::MeshSection& added = out_.mesh.meshSections.emplace_back(section);
        for (int bucket = 0; bucket < mesh::kDrawBucketCount; ++bucket) {
            for (int direction = 0; direction < mesh::kFaceDirectionCount; ++direction) {
                const mesh::QuadRange from = section.ranges[bucket][direction];
                const auto first = static_cast<std::uint32_t>(out_.mesh.quads.size());
                for (const shared::Quad quad : std::span(mesh.quads).subspan(from.first, from.count))
                    addQuad(quad);
                added.ranges[bucket][direction] = {
                    first, static_cast<std::uint32_t>(out_.mesh.quads.size()) - first};
            }
        }
    }

  private:
    void add(shared::Quad quad, const std::array<LightValue, 4>& corners) {
        out_.mesh.quads.push_back(quad);
        const auto pair = [](LightValue a, LightValue b) {
            return static_cast<shared::uint>(a) | static_cast<shared::uint>(b) << 16;
        };
        out_.light.push_back({pair(corners[0], corners[1]), pair(corners[2], corners[3])});
    }
    void addEven(shared::Quad quad, LightValue value) { add(quad, {value, value, value, value}); }

    void addQuad(shared::Quad quad) {
        if (!isLit_) return addEven(quad, light::kFullDaylight);
        const shared::ShapeFace& face = shapeFaces_[shared::quadShapeFace(quad)];
        const glm::ivec3 cell(shared::quadX(quad), shared::quadY(quad),
                              static_cast<int>(shared::quadZ(quad)) + base_);
        const shared::uint direction = shared::faceDirectionOf(face);
        if (direction >= shared::kDirectionPlant) return addEven(quad, block_.at(cell));
        addFace(quad, face, cell, direction);
    }

    void addFace(shared::Quad quad, const shared::ShapeFace& face, glm::ivec3 cell, shared::uint direction) {
        const glm::vec2 extent(shared::quadExtentU(quad), shared::quadExtentV(quad));
        const auto corner = [&](glm::vec2 at) {
            return glm::vec3(shared::shapeFaceCorner(face, glm::vec4(cell, 0), at, extent));
        };
        const auto axis = static_cast<glm::length_t>(direction >> 1);
        const glm::vec3 c0 = corner({0, 0});
        const int layer = floorOf(c0[axis] + (direction % 2 == 0 ? -0.5f : 0.5f));
        const glm::vec3 u = (corner({1, 0}) - c0) / extent.x, v = (corner({0, 1}) - c0) / extent.y;
        lattice_.columns = static_cast<int>(extent.x);
        lattice_.rows = static_cast<int>(extent.y);
        if (isEven(cell, axis, layer, u, v)) return addEven(quad, block_.at(inLayer(cell, axis, layer)));
        for (int j = 0; j <= lattice_.rows; ++j)
            for (int i = 0; i <= lattice_.columns; ++i)
                lattice_.at(i, j) = meanAround(corner(glm::vec2(i, j) / extent), axis, layer);
        const auto addPart = [&](Rectangle r) {
            add(part(quad, u, v, r), {packed(lattice_.at(r.i0, r.j0)), packed(lattice_.at(r.i1, r.j0)),
                                      packed(lattice_.at(r.i0, r.j1)), packed(lattice_.at(r.i1, r.j1))});
        };
        const Rectangle whole{0, lattice_.columns, 0, lattice_.rows};
        splitting_ == Splitting::On ? split(lattice_, whole, addPart) : addPart(whole);
    }

    static glm::ivec3 inLayer(glm::ivec3 block, glm::length_t axis, int layer) {
        block[axis] = layer;
        return block;
    }

    // Whether all blocks that light a face have the same light.
    bool isEven(glm::ivec3 cell, glm::length_t axis, int layer, glm::vec3 u, glm::vec3 v) const {
        glm::ivec3 low = inLayer(cell, axis, layer), high = low;
        for (glm::length_t k = 0; k < 3; ++k) {
            if (k == axis) continue;
            low[k] = cell[k] - 1;
            high[k] = cell[k] + std::max(std::abs(u[k]) > 0.5f ? lattice_.columns : 1,
                                         std::abs(v[k]) > 0.5f ? lattice_.rows : 1);
        }
        const LightValue value = block_.at(inLayer(cell, axis, layer));
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    if (const LightValue other = block_.at({x, y, z});
                        other != value && other != light::kDark)
                        return false;
        return value != light::kDark;
    }

    // Mean of the up to four blocks around a point of a layer that are not dark, in parts of a level.
    Levels meanAround(glm::vec3 at, glm::length_t axis, int layer) const {
        constexpr float kHalf = 0.499f;  // a point inside of a block has no others along that axis
        const glm::length_t a = (axis + 1) % 3, b = (axis + 2) % 3;
        glm::ivec3 block = inLayer({}, axis, layer);
        Levels sum{};
        int count = 0;
        for (const float stepA : {-kHalf, kHalf}) {
            for (const float stepB : {-kHalf, kHalf}) {
                block[a] = floorOf(at[a] + stepA);
                block[b] = floorOf(at[b] + stepB);
                const LightValue value = block_.at(block);
                if (value == light::kDark) continue;
                ++count;
                for (int k = 0; k < light::kComponentCount; ++k)
                    sum[static_cast<std::size_t>(k)] += light::levelOf(value, k);
            }
        }
        if (count > 0)
            for (int& component : sum) component = component * kParts / count;
        return sum;
    }

    // A part of a quad. Axes that point toward negative coordinates begin at the far side (shape_face.h).
    static shared::Quad part(shared::Quad quad, glm::vec3 u, glm::vec3 v, Rectangle r) {
        const auto along = [](glm::vec3 axis, int first, int last, int count) {
            glm::ivec3 moved(0);
            for (glm::length_t k = 0; k < 3; ++k) {
                if (axis[k] > 0.5f) moved[k] = first;
                if (axis[k] < -0.5f) moved[k] = count - last;
            }
            return moved;
        };
        const auto columns = static_cast<int>(shared::quadExtentU(quad)),
                   rows = static_cast<int>(shared::quadExtentV(quad));
        const glm::uvec3 moved(along(u, r.i0, r.i1, columns) + along(v, r.j0, r.j1, rows));
        return shared::packQuad({.x = shared::quadX(quad) + moved.x,
                                 .y = shared::quadY(quad) + moved.y,
                                 .z = shared::quadZ(quad) + moved.z,
                                 .shapeFace = shared::quadShapeFace(quad),
                                 .extentU = static_cast<shared::uint>(r.i1 - r.i0),
                                 .extentV = static_cast<shared::uint>(r.j1 - r.j0),
                                 .material = shared::quadMaterial(quad)});
    }

    const LightAround& around_;
    std::span<const shared::ShapeFace> shapeFaces_;
    Splitting splitting_;
    LitMesh& out_;
    bool isLit_;
    int base_ = 0;
    LightBlock block_;
    Lattice lattice_;
};

}  // namespace

LitMesh litAtCorners(const mesh::ChunkMesh& mesh, const LightAround& around,
                     std::span<const shared::ShapeFace> shapeFaces, Splitting splitting) {
    TERRANE_ZONE("light corners");
    LitMesh lit;
    lit.mesh.quads.reserve(mesh.quads.size());
    lit.light.reserve(mesh.quads.size());
    Lighter lighter(around, shapeFaces, splitting, lit);
    for (const mesh::MeshSection& section : mesh.meshSections) lighter.addMeshSection(mesh, section);
    return lit;
}

}  // namespace terrane::render
