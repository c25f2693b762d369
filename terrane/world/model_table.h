// Makes models of shapes and numbers their faces. Called by block_registry.cpp.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "terrane/world/block_model.h"

namespace terrane::world {

class ModelTable {
  public:
    // A quad has 11 bits for its shape face.
    static constexpr std::size_t kMaxFaces = shared::kMaxShapeFaces - shared::kShapeFaceCount;

    // One model for all blocks of a shape.
    std::shared_ptr<const BlockModel> modelOf(const ShapePtr& shape);

    // Limits of the bits in mesh_gpu/block_table.h: faces of a form, and forms with their faces in all.
    static constexpr std::size_t kMaxFormFaces = 255, kMaxEntries = 60'000;

    bool fits() const {
        return faces_.size() <= kMaxFaces && mostFormFaces_ <= kMaxFormFaces && entries_ <= kMaxEntries;
    }
    std::vector<shared::ShapeFace> takeFaces() { return std::move(faces_); }

  private:
    std::uint16_t number(const ShapeRectangle& rectangle);
    ModelForm formOf(const std::vector<ShapeBox>& boxes);

    std::map<ShapePtr, std::shared_ptr<const BlockModel>> models_;
    std::vector<ShapeRectangle> rectangles_;  // of faces_
    std::vector<shared::ShapeFace> faces_;
    std::size_t mostFormFaces_ = 0, entries_ = 0;
};

}  // namespace terrane::world
