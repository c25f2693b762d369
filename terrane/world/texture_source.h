// A source of textures of blocks: content, resource packs, tests.
#pragma once

#include <functional>
#include <string_view>

#include "terrane/base/image.h"
#include "terrane/base/result.h"

namespace terrane::world {

// The image of a texture by its name in the block types. An error says what is missing.
using TextureSource = std::function<base::Result<base::Image>(std::string_view)>;

}  // namespace terrane::world
