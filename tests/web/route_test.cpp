#include "terrane/web/route.h"

#include <gtest/gtest.h>

#include <limits>

#include "terrane/map/map_tile.h"

namespace terrane::web {
namespace {

Route routeTo(std::string_view text) {
    const auto target = parseTarget(text);
    EXPECT_TRUE(target) << text;
    return target ? routeOf(*target) : Route();
}

template <class Kind>
bool is(std::string_view text) {
    return std::holds_alternative<Kind>(routeTo(text));
}

std::optional<map::MapTile> tileAt(std::string_view text) {
    const Route route = routeTo(text);
    const auto* image = std::get_if<TileImage>(&route);
    return image ? std::optional(image->tile) : std::nullopt;
}

TEST(Route, EachHasATarget) {
    EXPECT_EQ(std::get<PageFile>(routeTo("/")).name, "index.html");
    EXPECT_EQ(std::get<PageFile>(routeTo("/map.css")).name, "map.css");
    EXPECT_TRUE(is<WorldScript>("/world.js"));
    EXPECT_TRUE(is<WorldInfo>("/api/world"));
    EXPECT_TRUE(is<PlayerList>("/api/players"));
    EXPECT_TRUE(is<EventStream>("/api/edits"));
    EXPECT_TRUE(is<Metrics>("/metrics"));
    EXPECT_TRUE(is<Health>("/healthz"));
    EXPECT_TRUE(is<Health>("/healthz?verbose=1")) << "parameters nobody asks for do not matter";
}

TEST(Route, OtherTargetsLeadNowhere) {
    for (const char* text : {"/api", "/api/", "/api/none", "/api/world/more", "/tiles", "/metrics/more",
                             "/page/index.html", "/tiles/day/0/0", "/healthz/x"}) {
        const auto target = parseTarget(text);
        EXPECT_TRUE(!target || std::holds_alternative<NotFound>(routeOf(*target))) << text;
    }
}

TEST(Route, TilesHaveLayerZoomAndNumbers) {
    EXPECT_EQ(tileAt("/tiles/day/0/0/0.png"), (map::MapTile{map::Layer::Day, 0, 0, 0}));
    EXPECT_EQ(tileAt("/tiles/night/2/-7/12.png"), (map::MapTile{map::Layer::Night, 2, -7, 12}));
    EXPECT_EQ(tileAt("/tiles/isometric/-10/3/-4.png"), (map::MapTile{map::Layer::Isometric, -10, 3, -4}));
    EXPECT_EQ(tileAt("/tiles/height/-1/1/1.png"), (map::MapTile{map::Layer::Height, -1, 1, 1}));
    EXPECT_EQ(tileAt("/tiles/biome/1/1/1.png"), (map::MapTile{map::Layer::Biome, 1, 1, 1}));
}

// The files written by "terrane maps" have the names that a server serves.
TEST(Route, TilesHaveTheNamesOfTheirFiles) {
    for (const map::MapTile& tile :
         {map::MapTile{map::Layer::Day, -10, 5, -6}, {map::Layer::Isometric, 2, -7, 0}})
        EXPECT_EQ(tileAt("/" + map::pathOf(tile)), tile);
}

TEST(Route, OtherTilesLeadNowhere) {
    for (const char* text :
         {"/tiles/dusk/0/0/0.png", "/tiles/Day/0/0/0.png", "/tiles/day/3/0/0.png", "/tiles/day/-11/0/0.png",
          "/tiles/day/0/0/0", "/tiles/day/0/0/0.jpg", "/tiles/day/0/0/.png", "/tiles/day/0/0/0.png.png",
          "/tiles/day/0/0x1/0.png", "/tiles/day/0/+1/0.png", "/tiles/day/0/1.0/0.png",
          "/tiles/day/0/1e3/0.png", "/tiles/day/0/%201/0.png", "/tiles/day/0/1%20/0.png",
          "/tiles/day/0/--1/0.png", "/tiles/day/0/-/0.png", "/tiles/day//0/0.png", "/tiles/day/0/0/0/0.png",
          "/tiles/day/0/99999999999/0.png"}) {
        const auto target = parseTarget(text);
        EXPECT_TRUE(!target || std::holds_alternative<NotFound>(routeOf(*target))) << text;
    }
}

TEST(Route, TilesEndWithTheWorld) {
    EXPECT_TRUE(tileAt("/tiles/day/0/8388607/-8388608.png"));
    EXPECT_FALSE(tileAt("/tiles/day/0/8388608/0.png"));
    EXPECT_FALSE(tileAt("/tiles/day/0/0/-8388609.png"));
    EXPECT_FALSE(tileAt("/tiles/day/-10/2147483647/-2147483648.png"));
    EXPECT_FALSE(tileAt("/tiles/isometric/2/2147483647/-2147483648.png"));
}

TEST(Route, BlocksHaveAnyNumbersOf32Bits) {
    const auto at = std::get<BlockAt>(routeTo("/api/block?y=2147483647&x=-2147483648"));
    EXPECT_EQ(at.x, std::numeric_limits<std::int32_t>::min());
    EXPECT_EQ(at.y, std::numeric_limits<std::int32_t>::max());
    for (const char* text :
         {"/api/block", "/api/block?x=1", "/api/block?y=1", "/api/block?x=&y=1",
          "/api/block?x=1&y=", "/api/block?x=2147483648&y=0", "/api/block?x=0&y=-2147483649",
          "/api/block?x=1.5&y=0", "/api/block?x=1&y=0%00", "/api/block?x=one&y=0", "/api/block?X=1&Y=1"}) {
        const Route route = routeTo(text);
        ASSERT_TRUE(std::holds_alternative<BadRequest>(route)) << text;
        EXPECT_FALSE(std::get<BadRequest>(route).why.empty());
    }
}

}  // namespace
}  // namespace terrane::web
