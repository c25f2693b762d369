// All block types and items of a session, read from content files. It is immutable; shared by all threads.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/shared/shape_face.h"
#include "terrane/world/blocks/block_behavior.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_type.h"

namespace terrane::world {

// Makes models of shapes and numbers their faces. block_registry.cpp calls it.
class ModelTable {
  public:
    // A quad has 11 bits for its shape face.
    static constexpr std::size_t kMaxFaces = shared::kMaxShapeFaces - shared::kShapeFaceCount;

    // Returns the model of a shape, one for all blocks with it.
    std::shared_ptr<const BlockModel> modelOf(const ShapePtr& shape);

    // Limits of the bits in mesh_gpu/block_table.h: faces of a form, and forms with their faces in all.
    static constexpr std::size_t kMaxFormFaces = 255, kMaxEntries = 60'000;

    bool fits() const {
        return faces_.size() <= kMaxFaces && mostFormFaces_ <= kMaxFormFaces && entries_ <= kMaxEntries;
    }
    std::vector<shared::ShapeFace> takeFaces() { return std::move(faces_); }

  private:
    std::uint16_t number(const shared::ShapeFace& face);
    ModelForm formOf(const ShapePart& part);

    std::map<ShapePtr, std::shared_ptr<const BlockModel>> models_;
    std::vector<shared::ShapeFace> faces_;
    std::size_t mostFormFaces_ = 0, entries_ = 0;
};

struct BlockDescription;  // block_description.h
struct ItemFile;          // items/item_table.h
class ItemTable;

class BlockRegistry {
  public:
    // Reads the content file's text. Errors read "name:line: key: what is wrong". Ids follow the order of the
    // file; air is 0 and is not in the file. The last type added is "missing". `behaviors` has the behaviors
    // that blocks may name.
    [[nodiscard]] static base::Result<BlockRegistry> parse(
        std::string_view toml, std::string_view name, const BehaviorTable& behaviors = builtInBehaviors());

    // Creates a registry from descriptions, of several files or made by a program. Names are unique and none
    // of "air", "missing"; textures and blocks of behaviors have the registry's names. Errors that belong to
    // no block begin with `name`. `items`: those that are no blocks, and recipes.
    [[nodiscard]] static base::Result<BlockRegistry> fromDescriptions(std::vector<BlockDescription> blocks,
                                                                      std::string_view name,
                                                                      std::span<const ItemFile> items = {});

    std::span<const BlockType> types() const { return types_; }  // index is the id
    const BlockType& type(BlockId id) const { return types_[id < types_.size() ? id : missing_]; }
    const BlockType* find(std::string_view name) const;  // null if there is none
    BlockId missing() const { return missing_; }         // stands for unknown blocks

    const ItemTable& items() const { return *items_; }

    // Returns the same blocks with fewer faces, for meshes of far tiles: cubes with holes are closed and not
    // animated. Ids and textures are the same.
    BlockRegistry forFarTiles() const;

    std::span<const Material> materials() const { return materials_; }
    std::span<const std::string> textures() const { return textures_; }  // names without folder and ending
    // Faces of models, numbered from shared::kShapeFaceCount on.
    std::span<const shared::ShapeFace> modelFaces() const { return modelFaces_; }

  private:
    std::vector<BlockType> types_, farTypes_;
    std::vector<Material> materials_;
    std::vector<std::string> textures_;
    std::vector<shared::ShapeFace> modelFaces_;
    std::unordered_map<std::string, BlockId> byName_;
    std::shared_ptr<const ItemTable> items_;
    BlockId missing_ = 0;
};

}  // namespace terrane::world
