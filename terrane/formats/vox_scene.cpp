// Places the models of a .vox file.
#include "terrane/formats/vox_scene_internal.h"

namespace terrane::formats {
namespace {

constexpr int kMaxVoxDepth = 64;
// Groups may be used several times, and so may groups in them: visits are limited, not nodes.
constexpr std::size_t kMaxVoxVisits = 1'000'000;

class SceneWalk {
  public:
    explicit SceneWalk(const VoxParts& parts) : parts_(parts) {}

    base::Result<std::vector<PlacedModel>> run() {
        visit(0, {}, 0);
        if (!problem_.empty()) return base::fail(base::ErrorCode::Damaged, ".vox: {}", problem_);
        if (models_.empty()) return base::fail(base::ErrorCode::Damaged, ".vox: its scene shows no model");
        return std::move(models_);
    }

  private:
    void visit(std::int32_t id, const VoxTransform& transform, int depth) {
        if (depth > kMaxVoxDepth) problem_ = "its scene is too deep";
        if (++visits_ > kMaxVoxVisits) problem_ = "its scene is too large";
        const auto found = parts_.nodes.find(id);
        if (found == parts_.nodes.end()) problem_ = "a node of its scene is missing";
        if (!problem_.empty() || found->second.isHidden) return;
        const VoxNode& node = found->second;
        if (node.kind == VoxNode::Kind::Shape) return place(node, transform);
        const VoxTransform inner =
            node.kind == VoxNode::Kind::Transform ? combined(transform, node.transform) : transform;
        for (const std::int32_t child : node.children) {
            visit(child, inner, depth + 1);
            if (!problem_.empty()) return;
        }
    }

    // Takes the first model of an animation.
    void place(const VoxNode& shape, const VoxTransform& transform) {
        if (shape.children.empty()) return;
        const auto model = static_cast<std::size_t>(shape.children[0]);
        if (shape.children[0] < 0 || model >= parts_.models.size())
            problem_ = "a model of its scene is missing";
        else
            models_.push_back({model, transform});
    }

    const VoxParts& parts_;
    std::vector<PlacedModel> models_;
    std::string problem_;
    std::size_t visits_ = 0;
};

std::size_t at(int axis) {
    return static_cast<std::size_t>(axis);
}

}  // namespace

VoxTransform combined(const VoxTransform& outer, const VoxTransform& inner) {
    VoxTransform result;
    result.step = outer.step;
    for (int row = 0; row < 3; ++row) {
        const int axis = outer.axis[at(row)], sign = outer.sign[at(row)];
        result.axis[at(row)] = inner.axis[at(axis)];
        result.sign[at(row)] = sign * inner.sign[at(axis)];
        result.step[row] += sign * inner.step[axis];
    }
    return result;
}

// Computes with twice the middle of the voxel, which is odd: half of one less is the voxel again.
glm::ivec3 placed(const VoxTransform& transform, glm::ivec3 modelSize, glm::ivec3 voxel) {
    const glm::ivec3 twice = 2 * (voxel - modelSize / 2) + 1;
    glm::ivec3 result(0);
    for (int row = 0; row < 3; ++row) {
        const int turned = transform.sign[at(row)] * twice[transform.axis[at(row)]];
        result[row] = (turned - 1) / 2 + ((turned - 1) % 2 < 0 ? -1 : 0) + transform.step[row];
    }
    return result;
}

base::Result<std::vector<PlacedModel>> placedModels(const VoxParts& parts) {
    if (!parts.nodes.empty()) return SceneWalk(parts).run();
    VoxTransform atOrigin;
    atOrigin.step = parts.models[0].size / 2;
    return std::vector<PlacedModel>{{0, atOrigin}};
}

}  // namespace terrane::formats
