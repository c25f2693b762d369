#include "terrane/mesh_gpu/block_table.h"

#include <cassert>
#include <map>

#include "terrane/mesh/draw_bucket.h"
#include "terrane/mesh/section_faces.h"
#include "terrane/world/blocks/block_model.h"

namespace terrane::mesh_gpu {
namespace {

using shared::uint;
using world::BlockType;
using world::Face;
using world::Shape;

static_assert(static_cast<uint>(Shape::Cube) == shared::kMeshShapeCube &&
              static_cast<uint>(Shape::Liquid) == shared::kMeshShapeLiquid &&
              static_cast<uint>(Shape::Cross) == shared::kMeshShapeCross &&
              static_cast<uint>(Shape::Hash) == shared::kMeshShapeHash &&
              static_cast<uint>(Shape::Inset) == shared::kMeshShapeInset &&
              static_cast<uint>(Shape::Model) == shared::kMeshShapeModel);

uint faceOf(std::uint16_t material, const world::BlockRegistry& blocks) {
    return material | static_cast<uint>(mesh::drawBucket(blocks.materials()[material])) << 16;
}

uint flagsOf(const BlockType& type, const world::BlockRegistry& blocks) {
    uint flags = static_cast<uint>(type.shape) | (type.opaqueCube ? shared::kMeshOpaqueBit : 0);
    for (uint side = 0; side < world::kFaceCount; ++side) {
        const auto face = static_cast<Face>(side);
        flags |= uint{mesh::hidesSameType(type, face, blocks)} << (shared::kMeshHidesShift + side);
        flags |= uint{mesh::mergesFaces(type, face, blocks)} << (shared::kMeshMergesShift + side);
    }
    return flags;
}

uint faceOf(const world::ModelFace& face) {
    return face.shapeFace | uint{face.look} << shared::kMeshFaceLookShift |
           uint{face.hiddenBy} << shared::kMeshFaceHiddenByShift |
           uint{face.direction} << shared::kMeshFaceDirectionShift |
           (face.isTwoSided ? shared::kMeshFaceTwoSidedBit : 0);
}

// Adds the forms of a model and returns the index of the first. Faces of all forms follow the forms.
uint addModel(std::vector<uint>& forms, const world::BlockModel& model) {
    const std::size_t first = forms.size();
    forms.resize(first + model.forms.size());
    std::map<std::vector<uint>, std::size_t> known;  // states of bits that do not matter give equal forms
    for (std::size_t k = 0; k < model.forms.size(); ++k) {
        std::vector<uint> faces;
        for (const world::ModelFace& face : model.forms[k].faces) faces.push_back(faceOf(face));
        assert(faces.size() < 256 && forms.size() < (1u << 24) && "within their bits");
        const auto [same, isNew] = known.try_emplace(faces, forms.size());
        if (isNew) forms.insert(forms.end(), faces.begin(), faces.end());
        forms[first + k] = static_cast<uint>(same->second | faces.size() << 24);
    }
    return static_cast<uint>(first);
}

}  // namespace

BlockTable::BlockTable(const world::BlockRegistry& blocks) {
    std::map<const world::BlockModel*, uint> models;  // shared by all blocks of a shape
    const auto formsOf = [&](const BlockType& type) {
        if (!type.model) return static_cast<uint>(forms.size()) | static_cast<uint>(type.growth.size()) << 16;
        const auto [known, isNew] = models.try_emplace(type.model.get());
        if (isNew) known->second = addModel(forms, *type.model);
        return known->second | uint{type.model->stateMask} << 16;
    };
    const auto add = [&](const BlockType& type) {
        shared::MeshType entry{};
        entry.flags = flagsOf(type, blocks);
        entry.forms = formsOf(type);
        for (std::size_t side = 0; side < world::kFaceCount; ++side) {
            entry.faces[side] = faceOf(type.material[side], blocks);
        }
        for (const std::uint16_t material : type.growth) forms.push_back(faceOf(material, blocks));
        types.push_back(entry);
    };
    for (const BlockType& type : blocks.types()) add(type);
    add(blocks.type(blocks.missing()));
    if (forms.empty()) forms.push_back(0);
    assert(forms.size() < 65536 && "a type has 16 bits for where its forms begin");
}

}  // namespace terrane::mesh_gpu
