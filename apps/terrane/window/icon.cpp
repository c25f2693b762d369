#include "apps/terrane/window/icon.h"

#include "terrane/content/built_in.h"

namespace terrane::app {

void setTerraneIcon(Window& window) {
    const auto image = content::builtInTextures()("grass_side");
    if (image) window.setIcon({image->width, image->height}, std::as_bytes(std::span(image->rgba)));
}

}  // namespace terrane::app
