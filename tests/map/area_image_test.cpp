#include "terrane/map/area_image.h"

#include <gmock/gmock.h>

#include <utility>
#include <vector>

#include "terrane/content/built_in.h"
#include "terrane/store/overlay_store.h"
#include "tests/map/map_fixture.h"

namespace terrane::map {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using world::ChunkPos;

class AreaImageTest : public testing::Test {
  protected:
    static MapPainter painterOf(const gen::LevelGenerators& generators,
                                store::ReadableStore* store = nullptr) {
        const auto textures = content::builtInTextures();
        return MapPainter::create({generators, contentBlocks(), textures, store}).value();
    }
    base::Result<base::Image> draw(MapPainter& painter, const ColumnRect& rect,
                                   const EditedPositions& edited = {}) {
        return drawArea(painter, rect, edited, jobs_, [](int) { return true; });
    }

    base::JobSystem jobs_{2};
};

// Wider than a piece and higher than a strip, by numbers that are no multiples of them.
constexpr int kWidth = 256 + 77, kHeight = 64 + 13;

TEST_F(AreaImageTest, PiecesFitTogether) {
    MapPainter painter = painterOf(generatorsOf("overworld"));
    for (const auto& [width, height] :
         {std::pair(kWidth, kHeight), std::pair(1, 1), std::pair(256, 64), std::pair(513, 1)}) {
        const ColumnRect rect{0, -103, 59, width, height};
        const auto image = draw(painter, rect);
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->width, width);
        EXPECT_EQ(image->height, height);
        EXPECT_TRUE(image->rgba == painter.paintArea(rect, {}).value().rgba) << width << "x" << height;
    }
}

TEST_F(AreaImageTest, EveryLevelHasOne) {
    store::MemoryStore store({.seed = kMapSeed, .generator = "continents", .generatorVersion = 1});
    const gen::LevelGenerators& generators = generatorsOf("continents");
    MapPainter painter = painterOf(generators, &store);
    EditedPositions edited;
    edited.add({0, 0});
    for (int level = 0; level <= world::kMaxLevel; ++level) {
        const ChunkPos tile{0, 0, static_cast<std::uint8_t>(level)};
        store.save(tile, chunkWithPillar(generators, tile, 3, 9, "lamp_red"), store::Provenance::Edited);
        ASSERT_TRUE(store.flush());
        const ColumnRect rect{level, -20, -9, kWidth, 30};
        const auto image = draw(painter, rect, edited), generated = draw(painter, rect);
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_TRUE(image->rgba == painter.paintArea(rect, edited).value().rgba) << "level " << level;
        // Columns run from the right: the pillar is in the column 3 and the row 9.
        const auto pillar = (static_cast<std::size_t>(9 + 9) * kWidth + (kWidth - 1 - 23)) * 4;
        const auto pixel = [&](const base::Image& of) {
            return std::vector<int>(of.rgba.begin() + static_cast<std::ptrdiff_t>(pillar),
                                    of.rgba.begin() + static_cast<std::ptrdiff_t>(pillar) + 4);
        };
        EXPECT_NE(pixel(*image), pixel(*generated)) << "level " << level;
    }
}

TEST_F(AreaImageTest, EndsWhereNobodyWantsIt) {
    MapPainter painter = painterOf(generatorsOf("flat"));
    std::vector<int> rows;
    const auto image = drawArea(painter, {0, 0, 0, 20, 300}, {}, jobs_, [&](int painted) {
        rows.push_back(painted);
        return painted < 128;
    });
    ASSERT_FALSE(image);
    EXPECT_THAT(image.error().message, HasSubstr("not wanted"));
    EXPECT_THAT(rows, ElementsAre(64, 128));
    rows.clear();
    EXPECT_TRUE(drawArea(painter, {0, 0, 0, 20, 130}, {}, jobs_, [&](int painted) {
        rows.push_back(painted);
        return true;
    }));
    EXPECT_THAT(rows, ElementsAre(64, 128, 130));
}

TEST_F(AreaImageTest, AnErrorOfAPieceIsThatOfTheImage) {
    MapPainter painter = painterOf(noGenerators());
    const auto image = draw(painter, {0, 0, 0, kWidth, kHeight});
    ASSERT_FALSE(image);
    EXPECT_THAT(image.error().message, HasSubstr("nothing is generated here"));
}

}  // namespace
}  // namespace terrane::map
