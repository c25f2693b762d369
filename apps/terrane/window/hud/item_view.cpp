#include "apps/terrane/window/hud/item_view.h"

#include <epoxy/gl.h>

#include <span>
#include <utility>

#include "apps/terrane/window/imgui_layer.h"
#include "terrane/base/log.h"

namespace terrane::app {

unsigned ItemImages::image(const std::string& texture) {
    const auto found = images_.find(texture);
    if (found != images_.end()) return found->second.id();
    gpu::Texture2D& made = images_[texture];
    const auto image = textures_(texture);
    if (!image) {
        base::logWarning("{}", image.error().message);
        return made.id();
    }
    made = gpu::Texture2D(glm::ivec2(image->width, image->height), GL_RGBA8, 1, "item");
    made.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(image->rgba)));
    return made.id();
}

void drawStack(ImDrawList& draw, ImVec2 min, ImVec2 max, const world::ItemStack& stack,
               const ItemLooks& looks, const world::ItemTable& table) {
    if (stack.count == 0) return;
    const float scale = uiScale(), edge = 3 * scale;
    if (const unsigned image = looks.image(stack.item); image != 0)
        draw.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(image)),
                      {min.x + edge, min.y + edge}, {max.x - edge, max.y - edge}, {0, 0}, {1, 1});
    const world::ItemType* type = table.find(stack.item);
    if (stack.wear > 0 && type && type->tool.uses > 0) {
        const float left = 1 - static_cast<float>(stack.wear) / static_cast<float>(type->tool.uses);
        const float width = max.x - min.x - 2 * edge, top = max.y - 2 * edge;
        const auto green = static_cast<int>(220 * left);
        draw.AddRectFilled({min.x + edge, top}, {max.x - edge, top + 2 * scale}, IM_COL32(0, 0, 0, 200));
        draw.AddRectFilled({min.x + edge, top}, {min.x + edge + width * left, top + 2 * scale},
                           IM_COL32(240 - green, green, 40, 255));
    }
    if (stack.count < 2) return;
    const std::string count = std::to_string(stack.count);
    const ImVec2 size = ImGui::CalcTextSize(count.c_str());
    const ImVec2 at(max.x - size.x - 2 * scale, max.y - size.y);
    draw.AddText({at.x + scale, at.y + scale}, IM_COL32(0, 0, 0, 255), count.c_str());
    draw.AddText(at, IM_COL32(255, 255, 255, 255), count.c_str());
}

}  // namespace terrane::app
