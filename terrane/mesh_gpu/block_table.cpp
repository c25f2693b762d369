#include "terrane/mesh_gpu/block_table.h"

#include "terrane/mesh/draw_bucket.h"
#include "terrane/mesh/face_rules.h"

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
              static_cast<uint>(Shape::Inset) == shared::kMeshShapeInset);

uint faceOf(std::uint16_t material, const world::BlockRegistry& blocks) {
    return material | static_cast<uint>(mesh::drawBucket(blocks.materials()[material])) << 16;
}

uint flagsOf(const BlockType& type, const world::BlockRegistry& blocks) {
    uint flags = static_cast<uint>(type.shape) | (type.opaqueCube ? shared::kMeshOpaqueBit : 0);
    for (uint side = 0; side < world::kFaceCount; ++side) {
        const auto face = static_cast<Face>(side);
        flags |= uint{mesh::hidesOwnKind(type, face, blocks)} << (shared::kMeshHidesShift + side);
        flags |= uint{mesh::mergesFaces(type, face, blocks)} << (shared::kMeshMergesShift + side);
    }
    return flags;
}

}  // namespace

BlockTable::BlockTable(const world::BlockRegistry& blocks) {
    const auto add = [&](const BlockType& type) {
        shared::MeshType entry{};
        entry.flags = flagsOf(type, blocks);
        entry.growth = static_cast<uint>(growth.size()) | static_cast<uint>(type.growth.size()) << 16;
        for (std::size_t side = 0; side < world::kFaceCount; ++side) {
            entry.faces[side] = faceOf(type.material[side], blocks);
        }
        for (const std::uint16_t material : type.growth) growth.push_back(faceOf(material, blocks));
        types.push_back(entry);
    };
    for (const BlockType& type : blocks.types()) add(type);
    add(blocks.type(blocks.missing()));
    if (growth.empty()) growth.push_back(0);
}

}  // namespace terrane::mesh_gpu
