// The faces of blocks that emit light, for light rays: in a grid of cells of 16³ blocks, which have groups of
// 4³ blocks, and all in one list.
// A light ray goes to a face near the surface or, less often, to any face of the scene, so that each has a
// chance. Immutable once made; any thread may use it.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "terrane/path/random.h"
#include "terrane/world/chunk.h"
#include "terrane/world/coords.h"

namespace terrane::path {

struct Emitter {
    world::ChunkPos tile;  // the face: chunk, block in it, and its number in the table of shapes
    world::BlockIndex block = 0;
    std::uint16_t shapeFace = 0, material = 0;
    bool isTwoSided = false;
    glm::dvec3 corner{0};  // with the axes: the corners counterclockwise, in blocks in the world
    glm::vec3 alongU{0}, alongV{0};
    glm::vec3 normal{0};
    float area = 0;
    float power = 0;  // luminance of what it emits, in all directions: relative to others
};

class EmitterTable {
  public:
    EmitterTable() = default;
    explicit EmitterTable(std::vector<Emitter> emitters);

    bool isEmpty() const { return emitters_.empty(); }
    std::size_t size() const { return emitters_.size(); }

    // A face by chance for light at a point, and its chance; none: no light ray this time.
    struct Choice {
        const Emitter* emitter;
        float chance;
    };
    std::optional<Choice> choose(const glm::dvec3& point, Random& random) const;
    // The chance that choose() returns the face.
    float chanceOf(const Emitter& emitter, const glm::dvec3& point) const;

    // Null if the face is none of them.
    const Emitter* find(world::ChunkPos tile, world::BlockIndex block, unsigned shapeFace) const;

  private:
    static constexpr int kCellBits = 4, kGroupBits = 2;
    static constexpr float kShareOfAll = 0.2f;  // of the light rays near emitters
    static constexpr float kChanceFar = 0.1f;   // of a light ray where none is near

    // Faces or groups that follow each other.
    struct Span {
        std::uint32_t first = 0, count = 0;
        float power = 0;
        glm::dvec3 middle{0};
        float least2 = 1;  // square of the distance: nearer ones count as if they were that far away

        float weight(const glm::dvec3& point) const;
    };
    struct Cell {
        Span groups;
        std::array<std::uint32_t, 27> near{};  // cells with faces: itself and those around it
        int nearCount = 0;
    };
    struct KeyHash {
        std::size_t operator()(const glm::ivec3& key) const;
    };
    static glm::ivec3 cellKeyOf(const glm::dvec3& point);
    const Cell* cellAt(const glm::dvec3& point) const;
    float nearWeight(const Cell& around, const glm::dvec3& point) const;
    float groupWeight(const Span& groups, const glm::dvec3& point) const;
    const Emitter* pick(float random) const;

    std::vector<Emitter> emitters_;       // by cell, then by group
    std::vector<std::uint32_t> groupOf_;  // by face
    std::vector<double> cumulative_;      // of their power
    std::vector<Span> groups_;
    std::vector<Cell> cells_;
    std::unordered_map<glm::ivec3, std::uint32_t, KeyHash> byPlace_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> byBlock_;
};

}  // namespace terrane::path
