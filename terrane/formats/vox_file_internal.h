// The parts of a .vox file, and the scene that places its models. vox_file.cpp uses it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/formats/vox_file.h"

namespace terrane::formats {

struct VoxModel {
    glm::ivec3 size{0};
    std::string_view voxels;  // four bytes each: x, y, z, color
};

// A permutation of the axes with signs, then a step. Row k of the matrix has `sign[k]` at column `axis[k]`.
struct VoxTransform {
    std::array<int, 3> axis{0, 1, 2}, sign{1, 1, 1};
    glm::ivec3 step{0};
};

// Returns the transform that applies `inner`, then `outer`.
VoxTransform combined(const VoxTransform& outer, const VoxTransform& inner);
// Returns the place of a voxel of a model: models turn about their middle, size / 2 rounded down.
glm::ivec3 placed(const VoxTransform& transform, glm::ivec3 modelSize, glm::ivec3 voxel);

struct VoxNode {
    enum class Kind : std::uint8_t { Transform, Group, Shape };
    Kind kind = Kind::Group;
    bool isHidden = false;    // itself or its layer
    std::int32_t layer = -1;  // -1: none; only transforms have one
    VoxTransform transform;
    std::vector<std::int32_t> children;  // nodes; of a shape: its models
};

struct VoxParts {
    std::vector<VoxModel> models;
    std::map<std::int32_t, VoxNode> nodes;
    std::array<std::uint32_t, 256> colors{};
};

// Reads the chunks of a file. The result has views into `bytes`.
[[nodiscard]] base::Result<VoxParts> readVoxParts(std::string_view bytes);

struct PlacedModel {
    std::size_t model = 0;
    VoxTransform transform;
};

// Returns the models of the scene; without a scene, the first one.
[[nodiscard]] base::Result<std::vector<PlacedModel>> placedModels(const VoxParts& parts);

}  // namespace terrane::formats
