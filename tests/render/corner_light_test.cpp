// Light at the corners of quads: against a slow reference, and after changes as from the beginning.
#include "terrane/render/quads/corner_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <set>
#include <tuple>

#include "terrane/render/quads/corner_lit_chunks.h"
#include "tests/mesh/random_blocks.h"

namespace terrane::render {
namespace {

constexpr world::Heights kLow{-16, 64};

enum class Lights { Even, Noise, Slope, Spots, Count };

light::LightValue randomLight(Lights lights, int x, int y, int z, unsigned seed) {
    const auto clamped = [](int level) { return static_cast<unsigned>(std::clamp(level, 0, 15)); };
    const unsigned hash = mesh::hashAt(x, y, z, seed);
    switch (lights) {
        case Lights::Noise:
            return static_cast<light::LightValue>(hash % 5 == 0 ? 0 : hash);
        case Lights::Slope:
            return static_cast<light::LightValue>(clamped(x / 2 + 4) | clamped(y / 2 + 5) << 4 |
                                                  clamped(z / 4) << 12);
        case Lights::Spots: {
            const int away = std::abs(x - 7) + std::abs(y - 5) + std::abs(z - 40);
            return static_cast<light::LightValue>(clamped(15 - away) | 0xF000u);
        }
        default:
            return light::kFullDaylight;
    }
}

light::ChunkLight makeLight(int originX, int originY, Lights lights, unsigned seed) {
    light::ChunkLight light(kLow);
    std::array<light::LightValue, world::kBlocksPerSection> values;
    for (int number = kLow.firstSection(); number < kLow.endSection(); ++number) {
        for (int i = 0; i < world::kBlocksPerSection; ++i)
            values[static_cast<std::size_t>(i)] = randomLight(
                lights, originX + (i & 15), originY + (i >> 4 & 15), number * 16 + (i >> 8), seed);
        light.setBrick(number, light::LightBrick::fromValues(values));
    }
    return light;
}

struct Place {
    std::vector<light::ChunkLight> lights;
    LightAround around{};
    mesh::ChunkMesh mesh;

    Place(Lights kind, mesh::Mix mix, unsigned seed) {
        for (int k = 0; k < 9; ++k)
            lights.push_back(makeLight(16 * (k % 3 - 1), 16 * (k / 3 - 1), kind, seed));
        for (std::size_t k = 0; k < 9; ++k) around[k] = &lights[k];
        const auto chunk = mesh::makeChunk(0, 0, mesh::randomBlocks(mix, seed), kLow);
        mesh = mesh::meshAlone(chunk, mesh::testBlocks());
    }

    light::LightValue at(glm::ivec3 block) const {
        if (block.z >= kLow.top) return light::kFullDaylight;
        if (block.z < kLow.bottom) return light::kDark;
        const int k = 3 * ((block.y >> 4) + 1) + (block.x >> 4) + 1;
        return lights[static_cast<std::size_t>(k)].get(block.x & 15, block.y & 15, block.z);
    }
};

const std::vector<shared::ShapeFace>& shapeFaces() {
    static const std::vector<shared::ShapeFace> faces = mesh::shapeFaces(mesh::testBlocks());
    return faces;
}

struct Face {
    shared::ShapeFace shape;
    glm::ivec3 cell;
    glm::vec2 extent;
    int axis, layer;

    Face(shared::Quad quad, int base)
        : shape(shapeFaces()[shared::quadShapeFace(quad)]),
          cell(shared::quadX(quad), shared::quadY(quad), static_cast<int>(shared::quadZ(quad)) + base),
          extent(shared::quadExtentU(quad), shared::quadExtentV(quad)) {
        const int direction = static_cast<int>(shared::faceDirectionOf(shape));
        axis = direction / 2;
        if (axis < 3)
            layer = static_cast<int>(std::floor(at(0, 0)[axis] + (direction % 2 == 0 ? -0.5f : 0.5f)));
    }
    // A point of the face: 0…1 along u and v.
    glm::vec3 at(float u, float v) const {
        return glm::vec3(shared::shapeFaceCorner(shape, glm::vec4(cell, 0), {u, v}, extent));
    }
};

// Levels at a point: the mean of the blocks in the layer that touch it, without dark ones.
std::array<float, 4> expectedAt(const Place& place, const Face& face, glm::vec3 at) {
    if (face.axis == 3) at = glm::vec3(face.cell) + 0.5f;
    std::set<std::tuple<int, int, int>> blocks;
    for (int corner = 0; corner < 8; ++corner) {
        glm::ivec3 block;
        for (int k = 0; k < 3; ++k)
            block[k] = static_cast<int>(std::floor(at[k] + (corner >> k & 1 ? 0.49f : -0.49f)));
        if (face.axis < 3) block[face.axis] = face.layer;
        if (face.axis == 3) block = face.cell;
        blocks.emplace(block.x, block.y, block.z);
    }
    std::array<float, 4> sum{};
    int count = 0;
    for (const auto& [x, y, z] : blocks) {
        const light::LightValue value = place.at({x, y, z});
        if (value == light::kDark) continue;
        ++count;
        for (int k = 0; k < 4; ++k)
            sum[static_cast<std::size_t>(k)] += static_cast<float>(light::levelOf(value, k));
    }
    for (float& component : sum) component /= static_cast<float>(std::max(count, 1));
    return sum;
}

light::LightValue cornerOf(shared::QuadLight light, unsigned corner) {
    return static_cast<light::LightValue>(shared::lightOfCorner(light, corner));
}

// Cells of a face by material and shape face, so that a split quad can be compared with the whole one.
using Cells = std::multiset<std::array<int, 5>>;
void addCells(Cells& cells, shared::Quad quad, int base) {
    const Face face(quad, base);
    glm::ivec3 size(1);
    for (int k = 0; k < 3; ++k) {
        if (std::abs(face.shape.axisU[k]) > 0.5f && face.extent.x > 1)
            size[k] = static_cast<int>(face.extent.x);
        if (std::abs(face.shape.axisV[k]) > 0.5f && face.extent.y > 1)
            size[k] = static_cast<int>(face.extent.y);
    }
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                cells.insert({face.cell.x + x, face.cell.y + y, face.cell.z + z,
                              static_cast<int>(shared::quadMaterial(quad)),
                              static_cast<int>(shared::quadShapeFace(quad))});
}

Cells cellsOf(const mesh::ChunkMesh& mesh, const mesh::MeshSection& section, int bucket, int direction) {
    Cells cells;
    const mesh::QuadRange range = section.ranges[bucket][direction];
    for (std::uint32_t k = 0; k < range.count; ++k)
        addCells(cells, mesh.quads[range.first + k], mesh::quadBase(section));
    return cells;
}

void expectLit(const Place& place, const LitMesh& lit) {
    ASSERT_EQ(lit.light.size(), lit.mesh.quads.size());
    int wrong = 0, uneven = 0;
    for (const mesh::MeshSection& section : lit.mesh.meshSections) {
        const std::uint32_t first = mesh::firstQuad(section);
        for (std::uint32_t k = first; k < first + mesh::quadCount(section); ++k) {
            const Face face(lit.mesh.quads[k], mesh::quadBase(section));
            std::array<std::array<float, 4>, 4> corners;
            for (unsigned corner = 0; corner < 4; ++corner) {
                const glm::vec2 at(corner & 1, corner >> 1);
                const auto expected = expectedAt(place, face, face.at(at.x, at.y));
                const light::LightValue value = cornerOf(lit.light[k], corner);
                for (int c = 0; c < 4; ++c) {
                    const auto i = static_cast<std::size_t>(c);
                    corners[corner][i] = expected[i];
                    // A half may be rounded up or down.
                    wrong += std::abs(static_cast<float>(light::levelOf(value, c)) - expected[i]) > 0.501f;
                }
            }
            const auto columns = static_cast<int>(face.extent.x), rows = static_cast<int>(face.extent.y);
            for (int j = 0; j <= rows && columns * rows > 1; ++j) {
                for (int i = 0; i <= columns; ++i) {
                    const float u = static_cast<float>(i) / face.extent.x,
                                v = static_cast<float>(j) / face.extent.y;
                    const auto here = expectedAt(place, face, face.at(u, v));
                    for (std::size_t c = 0; c < 4; ++c) {
                        const float linear = u + v <= 1
                                                 ? corners[0][c] + u * (corners[1][c] - corners[0][c]) +
                                                       v * (corners[2][c] - corners[0][c])
                                                 : corners[3][c] + (1 - u) * (corners[2][c] - corners[3][c]) +
                                                       (1 - v) * (corners[1][c] - corners[3][c]);
                        uneven += std::abs(here[c] - linear) > cornerLightTolerance(here[c]) + 0.01f;
                    }
                }
            }
        }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(uneven, 0);
}

TEST(CornerLight, IsThatOfASlowReference) {
    for (int kind = 0; kind < static_cast<int>(Lights::Count); ++kind) {
        for (int mix = 0; mix < static_cast<int>(mesh::Mix::UnknownIds); ++mix) {
            SCOPED_TRACE(testing::Message() << "light " << kind << ", blocks " << mix);
            const Place place(static_cast<Lights>(kind), static_cast<mesh::Mix>(mix),
                              7u + static_cast<unsigned>(mix));
            const LitMesh lit = litAtCorners(place.mesh, place.around, shapeFaces());
            expectLit(place, lit);
            ASSERT_EQ(lit.mesh.meshSections.size(), place.mesh.meshSections.size());
            for (std::size_t k = 0; k < lit.mesh.meshSections.size(); ++k) {
                const mesh::MeshSection &split = lit.mesh.meshSections[k],
                                        &whole = place.mesh.meshSections[k];
                EXPECT_EQ(std::tie(split.bottom, split.top, split.minZ, split.maxZ),
                          std::tie(whole.bottom, whole.top, whole.minZ, whole.maxZ));
                for (int bucket = 0; bucket < mesh::kDrawBucketCount; ++bucket)
                    for (int direction = 0; direction < mesh::kFaceDirectionCount; ++direction)
                        ASSERT_EQ(cellsOf(lit.mesh, split, bucket, direction),
                                  cellsOf(place.mesh, whole, bucket, direction));
            }
        }
    }
}

TEST(CornerLight, EvenLightSplitsNothing) {
    const Place place(Lights::Even, mesh::Mix::Terrain, 3);
    EXPECT_EQ(litAtCorners(place.mesh, place.around, shapeFaces()).mesh, place.mesh);
}

TEST(CornerLight, WithoutLightItIsDay) {
    const Place place(Lights::Noise, mesh::Mix::Terrain, 3);
    const LitMesh lit = litAtCorners(place.mesh, {}, shapeFaces());
    EXPECT_EQ(lit.mesh, place.mesh);
    for (const shared::QuadLight light : lit.light)
        for (unsigned corner = 0; corner < 4; ++corner)
            EXPECT_EQ(cornerOf(light, corner), light::kFullDaylight);
}

// The quads and light of each chunk, as the changes leave them.
class Shown {
  public:
    void take(CornerLitChunks& chunks) {
        while (const auto change = chunks.lightNext(shapeFaces())) add(*change);
    }
    void add(const CornerLitChunks::Change& change) {
        std::map<int, LitMesh>& sections = sections_[change.pos];
        std::erase_if(sections, [&](const auto& entry) {
            return change.meshSections.hasAny(entry.first, entry.first + kHeight);
        });
        for (const mesh::MeshSection& section : change.lit.mesh.meshSections) {
            const std::uint32_t first = mesh::firstQuad(section), count = mesh::quadCount(section);
            LitMesh& lit = sections[section.bottom];
            lit.mesh.quads.assign(change.lit.mesh.quads.begin() + first,
                                  change.lit.mesh.quads.begin() + first + count);
            lit.light.assign(change.lit.light.begin() + first, change.lit.light.begin() + first + count);
        }
        std::erase_if(sections, [](const auto& entry) { return entry.second.mesh.quads.empty(); });
    }
    void remove(world::ChunkPos pos) { sections_.erase(pos); }
    // Bytes to compare.
    std::map<std::tuple<int, int, int>, std::vector<unsigned>> words() const {
        std::map<std::tuple<int, int, int>, std::vector<unsigned>> all;
        for (const auto& [pos, sections] : sections_) {
            for (const auto& [bottom, lit] : sections) {
                std::vector<unsigned>& words = all[{pos.x, pos.y, bottom}];
                for (const shared::Quad quad : lit.mesh.quads)
                    words.insert(words.end(), {quad.word0, quad.word1});
                for (const shared::QuadLight light : lit.light)
                    words.insert(words.end(), {light.corners01, light.corners23});
            }
        }
        return all;
    }

  private:
    static constexpr int kHeight = mesh::MeshOptions().meshSectionHeight;
    std::map<world::ChunkPos, std::map<int, LitMesh>> sections_;
};

TEST(CornerLitChunks, ChangesEndAsAllAtOnce) {
    constexpr int kSide = 3;
    CornerLitChunks edited;
    Shown shown;
    std::map<world::ChunkPos, mesh::ChunkMesh> meshes;
    std::map<world::ChunkPos, light::ChunkLight> lights;
    for (unsigned step = 0; step < 120; ++step) {
        const unsigned hash = mesh::hashAt(static_cast<int>(step), 1, 2, 5);
        const world::ChunkPos pos{static_cast<int>(hash % kSide), static_cast<int>(hash / kSide % kSide)};
        const auto blocks = mesh::randomBlocks(mesh::Mix::Terrain, hash >> 8 & 3);
        if (hash >> 16 & 1) {
            // New light of some bricks, or of all.
            const light::ChunkLight all =
                makeLight(16 * pos.x, 16 * pos.y, static_cast<Lights>(hash >> 17 & 3), 1);
            world::SectionSet bricks = world::SectionSet::all(kLow);
            if (lights.contains(pos) && (hash >> 19 & 1)) {
                bricks = {};
                for (int number = kLow.firstSection(); number < kLow.endSection(); number += 2)
                    bricks.add(number);
            }
            light::ChunkLight& light = lights.try_emplace(pos, kLow).first->second;
            bricks.forEach([&](int number) { light.setBrick(number, all.brick(number)); });
            edited.setLight(pos, light, bricks);
        } else if ((hash >> 21 & 7) == 0) {
            edited.remove(pos);
            shown.remove(pos);
            meshes.erase(pos);
            lights.erase(pos);
        } else {
            const auto chunk = mesh::makeChunk(16 * pos.x, 16 * pos.y, blocks, kLow);
            mesh::MeshSectionSet set;
            if (hash >> 17 & 1) {
                for (int part = -1; part < 3; ++part) set.add(part);
            } else {
                set = mesh::kAllMeshSections;
            }
            const mesh::ChunkMesh whole = mesh::meshAlone(chunk, mesh::testBlocks());
            const mesh::ChunkMesh part = mesh::withMeshSections({}, whole, set);
            meshes[pos] = mesh::withMeshSections(meshes[pos], part, set);
            edited.setMesh(pos, part, set);
            if (hash >> 18 & 1) shown.add(edited.light(pos, shapeFaces()));
        }
        if (hash >> 20 & 1) shown.take(edited);
    }
    shown.take(edited);
    CornerLitChunks atOnce;
    Shown expected;
    for (const auto& [pos, light] : lights) atOnce.setLight(pos, light, world::SectionSet::all(kLow));
    for (const auto& [pos, mesh] : meshes) atOnce.setMesh(pos, mesh);
    expected.take(atOnce);
    EXPECT_EQ(shown.words(), expected.words());
}

TEST(CornerLitChunks, TheSameLightLightsNothingAgain) {
    CornerLitChunks chunks;
    const Place place(Lights::Spots, mesh::Mix::Terrain, 3);
    chunks.setLight({}, place.lights[4], world::SectionSet::all(kLow));
    chunks.setMesh({}, place.mesh);
    EXPECT_TRUE(chunks.lightNext(shapeFaces()));
    chunks.setLight({}, place.lights[4], world::SectionSet::all(kLow));
    EXPECT_FALSE(chunks.lightNext(shapeFaces()));
    chunks.setLight({1, 1}, place.lights[8], world::SectionSet::all(kLow));
    EXPECT_TRUE(chunks.lightNext(shapeFaces())) << "its corner touches that chunk";
    chunks.setLight({1, 1}, place.lights[0], world::SectionSet::all(kLow));
    chunks.remove({});
    EXPECT_FALSE(chunks.lightNext(shapeFaces()));
}

}  // namespace
}  // namespace terrane::render
