#include "terrane/web/map_site.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "terrane/content/built_in.h"
#include "terrane/store/overlay_store.h"
#include "tests/base/temp_folder.h"
#include "tests/map/map_fixture.h"
#include "tests/support/default_heights.h"
#include "tests/web/web_fixture.h"

namespace terrane::web {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using world::ChunkPos;

class MapSiteTest : public testing::Test {
  protected:
    MapSiteParts parts(const std::string& generator) {
        store_ = std::make_unique<store::MemoryStore>(store::WorldIdentity{
            map::kMapSeed, generator, gen::versionOf(gen::builtInGenerators(), generator)});
        MapSiteParts parts{.generators = map::generatorsOf(generator),
                           .blocks = contentBlocks(),
                           .textures = textures_,
                           .store = *store_,
                           .name = "Ada's world",
                           .spawn = {"spawn", 8, 8, 81}};
        parts.liveChunk = [this](ChunkPos pos) -> world::ChunkPtr {
            const auto found = live_.find(pos);
            return found == live_.end() ? nullptr : found->second;
        };
        parts.players = [this] { return players_; };
        parts.places = [] { return std::vector<MapMarker>{{"mill", 1, 2, 3}}; };
        parts.metrics = [](MetricsText& text) { text.gauge("test_figure", "Of the test.", 42); };
        return parts;
    }
    void open(MapSiteParts siteParts) {
        auto site = MapSite::open(context_, std::move(siteParts), {});
        if (!site) throw std::runtime_error(site.error().message);
        site_ = std::move(*site);
    }
    template <class Condition>
    bool runUntil(Condition isSo) {
        return runContextUntil(context_, [&] {
            site_->tick();
            return isSo();
        });
    }
    Received get(const std::string& target, const std::string& fields = {}) {
        Browser browser(site_->port());
        browser.get(target, fields);
        std::optional<Received> found;
        EXPECT_TRUE(runUntil([&] { return (found = browser.take()).has_value() || browser.isClosed(); }))
            << target;
        return found.value_or(Received{});
    }
    nlohmann::json getJson(const std::string& target) {
        const Received answer = get(target);
        EXPECT_EQ(answer.status, 200) << target;
        EXPECT_EQ(answer.field("Content-Type"), "application/json") << target;
        return nlohmann::json::parse(answer.body);
    }

    boost::asio::io_context context_;
    world::TextureSource textures_ = content::builtInTextures();
    std::unique_ptr<store::MemoryStore> store_;
    std::map<ChunkPos, world::ChunkPtr> live_;
    std::vector<MapMarker> players_;
    std::unique_ptr<MapSite> site_;
};

TEST_F(MapSiteTest, GivesThePage) {
    open(parts("flat"));
    const Received page = get("/");
    EXPECT_EQ(page.status, 200);
    EXPECT_THAT(page.field("Content-Type"), StartsWith("text/html"));
    EXPECT_THAT(page.body, HasSubstr("<script src=\"world.js\">"));
    EXPECT_EQ(get("/", "If-None-Match: " + page.field("ETag") + "\r\n").status, 304);
    EXPECT_THAT(get("/leaflet.js").field("Content-Type"), StartsWith("text/javascript"));
    EXPECT_EQ(get("/package.json").status, 404);
    EXPECT_EQ(get("/none").status, 404);
    const Received script = get("/world.js");
    EXPECT_THAT(script.field("Content-Type"), StartsWith("text/javascript"));
    EXPECT_THAT(script.body, StartsWith("window.terraneWorld = {"));
    EXPECT_EQ(get("/healthz").body, "ok\n");
}

TEST_F(MapSiteTest, TellsOfTheWorld) {
    open(parts("flat"));
    const auto world = getJson("/api/world");
    EXPECT_EQ(world["name"], "Ada's world");
    EXPECT_EQ(world["seed"], "1");
    EXPECT_EQ(world["generator"], "flat");
    EXPECT_EQ(world["layers"], (nlohmann::json{"day", "night", "height", "isometric"}))
        << "flat has no biomes";
    EXPECT_EQ(world["places"][0]["name"], "mill");
    EXPECT_EQ(world["spawn"]["z"], 81);
    EXPECT_TRUE(world["isLive"]);
    EXPECT_EQ(getJson("/api/players").size(), 0u);
    players_ = {{"Ada", 1.5, -2, 80}};
    // The list changes within a second, however often it is requested.
    const auto end = std::chrono::steady_clock::now() + base::kHangs;
    while (getJson("/api/players").empty() && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(getJson("/api/players")[0]["name"], "Ada");
    const auto block = getJson("/api/block?x=-5&y=7");
    EXPECT_EQ(block["x"], -5);
    EXPECT_EQ(block["y"], 7);
    EXPECT_EQ(block["z"], 80);
    EXPECT_EQ(block["block"], "grass");
    EXPECT_EQ(block["biome"], "");
    EXPECT_EQ(getJson("/api/block?x=-2147483648&y=2147483647")["block"], "grass");
    EXPECT_EQ(get("/api/block?x=a&y=7").status, 400);
}

TEST_F(MapSiteTest, TilesArePngs) {
    open(parts("continents"));
    for (const char* target :
         {"/tiles/day/-6/0/0.png", "/tiles/night/2/-1/0.png", "/tiles/height/-2/1/-1.png",
          "/tiles/biome/-3/0/0.png", "/tiles/isometric/-7/0/0.png"}) {
        const Received tile = get(target);
        EXPECT_EQ(tile.status, 200) << target;
        EXPECT_EQ(tile.field("Content-Type"), "image/png");
        const auto image = base::decodePng(tile.body, target);
        ASSERT_TRUE(image) << target;
        EXPECT_EQ(image->width, 256);
        EXPECT_EQ(image->height, 256);
        const Received again = get(target, "If-None-Match: " + tile.field("ETag") + "\r\n");
        EXPECT_EQ(again.status, 304) << target;
        EXPECT_EQ(again.body, "");
    }
    EXPECT_EQ(get("/tiles/day/0/99999999/0.png").status, 404);
    EXPECT_EQ(getJson("/api/world")["layers"].size(), 5u);
    EXPECT_NE(getJson("/api/block?x=0&y=0")["biome"], "");
}

TEST_F(MapSiteTest, ALayerThatTheWorldLacksIsNotFound) {
    open(parts("flat"));
    EXPECT_EQ(get("/tiles/biome/0/0/0.png").status, 404);
}

TEST_F(MapSiteTest, FiguresAreForPrometheus) {
    open(parts("flat"));
    EXPECT_EQ(get("/tiles/day/2/0/0.png").status, 200);
    EXPECT_EQ(get("/none").status, 404);
    const Received metrics = get("/metrics");
    EXPECT_THAT(metrics.field("Content-Type"), StartsWith("text/plain; version=0.0.4"));
    EXPECT_THAT(metrics.body, HasSubstr("\nterrane_map_tiles_painted_total 1\n"));
    EXPECT_THAT(metrics.body, HasSubstr("\nterrane_web_answers_total{status=\"4xx\"} 1\n"));
    EXPECT_THAT(metrics.body, HasSubstr("\ntest_figure 42\n"));
    EXPECT_THAT(metrics.body, testing::EndsWith("\n"));
}

TEST_F(MapSiteTest, AnEditIsToldAndShown) {
    open(parts("flat"));
    const std::string target = "/tiles/day/2/0/0.png";
    const Received before = get(target);
    Browser listener(site_->port());
    listener.get("/api/edits");
    // A new listener gets the lists within a second.
    EXPECT_TRUE(runUntil([&] { return listener.text().find("event: places\n") != std::string::npos; }));

    const ChunkPos chunk{2, 1};
    live_[chunk] = map::chunkWithPillar(map::generatorsOf("flat"), chunk, 3, 4, "lamp_red");
    site_->onChanged(std::span(&chunk, 1));
    const std::string expected =
        "event: edits\ndata: "
        "{\"boxes\":[{\"level\":0,\"x0\":32,\"x1\":47,\"y0\":16,\"y1\":31}],\"number\":";
    EXPECT_TRUE(runUntil([&] { return listener.text().find(expected) != std::string::npos; }))
        << listener.text();

    const Received after = get(target, "If-None-Match: " + before.field("ETag") + "\r\n");
    EXPECT_EQ(after.status, 200);
    EXPECT_NE(after.field("ETag"), before.field("ETag"));
    EXPECT_NE(after.body, before.body);
    const auto block = getJson("/api/block?x=35&y=20");
    EXPECT_EQ(block["block"], "lamp_red");
    EXPECT_EQ(block["z"], 200);
    players_ = {{"Ada", 1, 2, 3}};
    EXPECT_TRUE(runUntil([&] { return listener.text().find("\"Ada\"") != std::string::npos; }));
}

// A page detects missed edits by the number, also after a restart of the program.
TEST_F(MapSiteTest, EditsHaveNumbersThatGoOn) {
    open(parts("flat"));
    const auto first = getJson("/api/world")["edits"].get<std::uint64_t>();
    EXPECT_LT(first, std::uint64_t{1} << 52) << "pages count in doubles";
    Browser listener(site_->port());
    listener.get("/api/edits");
    const auto hears = [&](std::uint64_t number) {
        const std::string text = "\"number\":" + std::to_string(number) + "}";
        return runUntil([&] { return listener.text().find(text) != std::string::npos; });
    };
    EXPECT_TRUE(hears(first)) << "who comes is told the newest";
    const ChunkPos chunk{2, 1};
    live_[chunk] = map::chunkWithPillar(map::generatorsOf("flat"), chunk, 3, 4, "lamp_red");
    site_->onChanged(std::span(&chunk, 1));
    EXPECT_TRUE(hears(first + 1));
    EXPECT_EQ(getJson("/api/world")["edits"], first + 1);
    // Another run, at whatever date, has other numbers: by chance, one of 2^51 has not.
    open(parts("flat"));
    const auto next = getJson("/api/world")["edits"].get<std::uint64_t>();
    EXPECT_TRUE(next != first + 1 && next != first + 2) << next;
}

// The map does not reveal where somebody digs.
TEST_F(MapSiteTest, EditsThatAreNotSeenFromAboveAreNotTold) {
    open(parts("flat"));
    const std::string target = "/tiles/day/2/0/0.png";
    const std::string tag = get(target).field("ETag");
    const ChunkPos deep{1, 1}, high{2, 1};
    auto dug = std::make_shared<world::Chunk>(map::generatorsOf("flat").generate(deep));
    dug->setBlock(world::blockIndex(3, 3, 20), world::kAir);
    live_[deep] = dug;
    live_[high] = map::chunkWithPillar(map::generatorsOf("flat"), high, 3, 4, "lamp_red");
    Browser listener(site_->port());
    listener.get("/api/edits");
    site_->onChanged(std::span(&deep, 1));
    const std::vector<ChunkPos> both{high, {1, 0, 1}};
    site_->onChanged(both);
    EXPECT_TRUE(runUntil([&] { return listener.text().find("\"x0\":32") != std::string::npos; }));
    EXPECT_EQ(listener.text().find("\"x0\":16"), std::string::npos) << "who digs is not told of";
    EXPECT_EQ(listener.text().find("\"level\":1"), std::string::npos) << "a tile without a row";
    EXPECT_NE(get(target).field("ETag"), tag);
    // A hole that is open to the sky is visible.
    auto open = std::make_shared<world::Chunk>(*dug);
    for (int z = 21; z < world::kChunkHeight; ++z) open->setBlock(world::blockIndex(3, 3, z), world::kAir);
    live_[deep] = open;
    site_->onChanged(std::span(&deep, 1));
    EXPECT_TRUE(runUntil([&] { return listener.text().find("\"x0\":16") != std::string::npos; }));
}

TEST_F(MapSiteTest, SavedEditsAreShownFromTheStart) {
    MapSiteParts siteParts = parts("flat");
    const ChunkPos chunk{0, 0};
    store_->save(chunk, map::chunkWithPillar(map::generatorsOf("flat"), chunk, 3, 4, "lamp_red"),
                 store::Provenance::Edited);
    ASSERT_TRUE(store_->flush());
    siteParts.edited = store_->editedChunks().value();
    open(std::move(siteParts));
    EXPECT_EQ(getJson("/api/block?x=3&y=4")["block"], "lamp_red");
    const std::string png = get("/tiles/day/2/0/0.png").body;
    EXPECT_NE(png, get("/tiles/day/2/3/0.png").body);
    EXPECT_EQ(get("/tiles/day/2/2/2.png").body, get("/tiles/day/2/3/0.png").body) << "flat land is alike";
}

TEST_F(MapSiteTest, ACacheOnTheDiskIsFilledAndTold) {
    base::TempFolder folder;
    const auto cache = map::SurfaceCache::open(folder / "map.sqlite", "flat", 10 << 20).value();
    MapSiteParts siteParts = parts("flat");
    siteParts.cache = cache.get();
    open(std::move(siteParts));
    EXPECT_EQ(get("/tiles/day/0/0/0.png").status, 200);
    EXPECT_TRUE(cache->contains({0, 0, 0}));
    EXPECT_THAT(get("/metrics").body, HasSubstr("\nterrane_map_disk_bytes "));
    site_.reset();
}

TEST_F(MapSiteTest, ItMayEndWhileOthersWait) {
    open(parts("continents"));
    std::vector<Browser> browsers;
    for (int k = 0; k < 6; ++k) {
        browsers.emplace_back(site_->port());
        browsers.back().get(k % 2 ? "/tiles/day/0/" + std::to_string(k) + "/0.png" : "/api/block?x=1&y=2");
    }
    Browser listener(site_->port());
    listener.get("/api/edits");
    context_.restart();
    context_.run_for(std::chrono::milliseconds(20));
    site_.reset();
    EXPECT_TRUE(runContextUntil(context_, [&] { return listener.isClosed() && browsers.back().isClosed(); }));
}

}  // namespace
}  // namespace terrane::web
