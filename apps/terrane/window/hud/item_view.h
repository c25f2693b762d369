// Images of items, and a slot with its stack: for hotbar, chests and the inventory. Immediate mode.
#pragma once

#include <imgui.h>

#include <functional>
#include <map>
#include <string>

#include "terrane/gpu/texture.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/inventory.h"
#include "terrane/world/items/item_table.h"

namespace terrane::app {

// Image and name of an item, by its name in the inventory.
struct ItemLooks {
    std::function<unsigned(const std::string&)> image;    // OpenGL texture, 0: none
    std::function<std::string(const std::string&)> name;  // translated
};

// Textures of items that are no blocks, uploaded when they are shown first. It is used on the thread of the
// OpenGL context.
class ItemImages {
  public:
    explicit ItemImages(world::TextureSource textures) : textures_(std::move(textures)) {}

    // Returns the OpenGL texture of an item's texture; 0 if it cannot be read.
    unsigned image(const std::string& texture);

  private:
    world::TextureSource textures_;
    std::map<std::string, gpu::Texture2D> images_;
};

// Draws the image, the count and the wear of a stack between two corners. `table`: knows how long tools last.
void drawStack(ImDrawList& draw, ImVec2 min, ImVec2 max, const world::ItemStack& stack,
               const ItemLooks& looks, const world::ItemTable& table);

}  // namespace terrane::app
