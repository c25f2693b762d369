// Packs in memory for tests.
#pragma once

#include <string>
#include <vector>

#include "terrane/base/image.h"
#include "terrane/pack/pack.h"

namespace terrane::pack {

inline std::string pngOf(int width, int height) {
    base::Image image{width, height,
                      std::vector<std::uint8_t>(static_cast<std::size_t>(width * height) * 4, 200)};
    return base::encodePng(image).value();
}

inline std::string infoOf(const std::string& name, const std::string& more = "") {
    return "format = 1\nname = \"" + name + "\"\n" + more;
}

constexpr const char* kGlowBlocks = R"(
[[block]]
name = "glow"
shape = "cube"
texture = "glow"
alpha = "glow"
emission = [1, 2, 3]

[[block]]
name = "step"
shape = "stairs"
texture = "stone"
opacity = 15
)";

constexpr const char* kFlatScript = R"(
g:pass3D("ground", function(p)
  p:setBlock(select(p.z:le(70), "glow", "air"))
end)
)";

// A pack with a textured block, one of a built-in shape, and a generator.
inline PackFiles glowFiles(const std::string& name) {
    return {{"pack.toml", infoOf(name, "version = \"1.2\"\n")},
            {"blocks.toml", kGlowBlocks},
            {"textures/glow.png", pngOf(16, 16)},
            {"generators/flat.lua", kFlatScript},
            {"languages/en.toml", "[blocks]\nglow = \"Glowing thing\"\n"}};
}

inline Pack packOfFiles(PackFiles files, const std::string& where = "p") {
    return makePack(std::move(files), where).value();
}

}  // namespace terrane::pack
