#include "terrane/map/paint.h"

#include <map>
#include <string>
#include <string_view>

#include "terrane/content/built_in.h"
#include "tests/map/map_fixture.h"

namespace terrane::map {
namespace {

TEST(MapColors, EachTextureIsReadOnce) {
    const auto textures = content::builtInTextures();
    std::map<std::string, int> reads;
    const world::TextureSource counting = [&](std::string_view name) {
        ++reads[std::string(name)];
        return textures(name);
    };
    ASSERT_TRUE(mapColors(contentBlocks(), counting));
    EXPECT_GT(reads.size(), 50u);
    for (const auto& [name, count] : reads) EXPECT_EQ(count, 1) << name;
}

TEST(MapColors, ALiquidThatShinesHidesItsGround) {
    BlockColor lava{.mean = {0.9f, 0.4f, 0.1f}, .kind = SurfaceKind::Liquid};
    EXPECT_NE(rgbOf(colorOfLiquid(lava, lava.mean, glm::vec3(0.5f), 1)), rgbOf(lava.mean));
    lava.reach = 15;
    EXPECT_EQ(rgbOf(colorOfLiquid(lava, lava.mean, glm::vec3(0.5f), 1)), rgbOf(lava.mean));
}

}  // namespace
}  // namespace terrane::map
