#include "terrane/web/static_map.h"

#include <gtest/gtest.h>

#include "tests/base/temp_folder.h"

namespace terrane::web {
namespace {

class StaticMap : public testing::Test {
  protected:
    StaticMap() {
        io::WorldOptions options;
        options.generator = "flat";
        options.threads = 2;
        world_ = io::openMapWorld(options, {}, "").value();
        painter_.emplace(io::painterOf(*world_).value());
        settings_.folder = folder_ / "map";
        settings_.area = {0, 0, 2, 2};
        settings_.layers = {map::Layer::Day};
    }
    base::Result<StaticMapWritten> write(const io::Progress& progress = {}) {
        return writeStaticMap(*world_, *painter_, settings_, progress);
    }

    base::TempFolder folder_;
    std::unique_ptr<io::MapWorld> world_;
    std::optional<map::MapPainter> painter_;
    StaticMapSettings settings_;
};

TEST_F(StaticMap, ASecondCallWritesOnlyMissingImages) {
    const auto first = write();
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_TRUE(first->isDone);
    EXPECT_GT(first->images, 0u);
    EXPECT_EQ(first->written, first->images);
    EXPECT_EQ(imageCountOf(settings_), static_cast<std::int64_t>(first->images));
    EXPECT_TRUE(std::filesystem::exists(settings_.folder / "world.js"));
    const auto second = write();
    ASSERT_TRUE(second) << second.error().message;
    EXPECT_EQ(second->written, 0u);
}

TEST_F(StaticMap, StopsWhenAsked) {
    const auto stopped = write([](std::size_t, std::size_t) { return false; });
    ASSERT_TRUE(stopped) << stopped.error().message;
    EXPECT_FALSE(stopped->isDone);
    EXPECT_EQ(stopped->written, 0u);
}

TEST_F(StaticMap, OtherFilesAreLeftAlone) {
    std::filesystem::create_directories(settings_.folder / "photos");
    EXPECT_FALSE(write());
}

TEST_F(StaticMap, NeedsABaseLayer) {
    EXPECT_FALSE(layersOf({"height"}, *painter_));
    EXPECT_FALSE(layersOf({"weather"}, *painter_));
    ASSERT_TRUE(layersOf({"day"}, *painter_));
    EXPECT_GT(layersOf({}, *painter_).value().size(), 1u);
}

TEST_F(StaticMap, AMapOfTooManyImagesIsRefused) {
    settings_.area = {-1'000'000, -1'000'000, 1'000'000, 1'000'000};
    EXPECT_GT(imageCountOf(settings_), kMaxImages);
    EXPECT_FALSE(write());
    EXPECT_FALSE(std::filesystem::exists(settings_.folder));
}

}  // namespace
}  // namespace terrane::web
