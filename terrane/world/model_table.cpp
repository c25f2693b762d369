#include "terrane/world/model_table.h"

#include <algorithm>
#include <glm/common.hpp>

namespace terrane::world {
namespace {

constexpr std::size_t kBulkyParts = kCellParts / 4;

Box boxOf(const ShapeBox& box) {
    constexpr float kPart = 1.0f / kSixteenths;
    return {kPart * glm::vec3(box.min), kPart * glm::vec3(box.max)};
}

bool isOnBorder(const ShapeRectangle& rectangle) {
    return rectangle.min[rectangle.side / 2] == (rectangle.side % 2 == 1 ? kSixteenths : 0);
}

}  // namespace

std::shared_ptr<const BlockModel> ModelTable::modelOf(const ShapePtr& shape) {
    std::shared_ptr<const BlockModel>& known = models_[shape];
    if (known) return known;
    auto model = std::make_shared<BlockModel>();
    model->stateMask = formMask(*shape);
    model->isBulky = filledParts(shape->boxes) >= kBulkyParts;
    for (unsigned state = 0; state <= model->stateMask; ++state) {
        const unsigned form = state & model->stateMask;  // that of a lower state where other bits are set
        model->forms.push_back(form < state ? model->forms[form]
                                            : formOf(boxesOf(*shape, static_cast<std::uint16_t>(form))));
    }
    entries_ += model->forms.size();
    known = std::move(model);
    return known;
}

ModelForm ModelTable::formOf(const std::vector<ShapeBox>& boxes) {
    ModelForm form;
    for (const ShapeBox& box : boxes) {
        form.boxes.push_back(boxOf(box));
        const Box& added = form.boxes.back();
        if (form.boxes.size() == 1) form.bounds = added;
        form.bounds = {glm::min(form.bounds.min, added.min), glm::max(form.bounds.max, added.max)};
    }
    for (const ShapeRectangle& rectangle : surfaceOf(boxes))
        form.faces.push_back({number(rectangle), rectangle.side, isOnBorder(rectangle)});
    mostFormFaces_ = std::max(mostFormFaces_, form.faces.size());
    entries_ += form.faces.size();
    return form;
}

std::uint16_t ModelTable::number(const ShapeRectangle& rectangle) {
    if (!fits()) return 0;  // the blocks are refused
    const auto known = std::ranges::find(rectangles_, rectangle);
    const auto index = static_cast<std::size_t>(known - rectangles_.begin());
    if (known == rectangles_.end()) {
        rectangles_.push_back(rectangle);
        faces_.push_back(shapeFaceOf(rectangle));
    }
    return static_cast<std::uint16_t>(shared::kShapeFaceCount + index);
}

}  // namespace terrane::world
