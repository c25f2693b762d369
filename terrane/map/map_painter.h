// Paints tiles of a world's map: finds the surfaces, chooses the painter of the layer, and makes a PNG. Any
// number of threads may use it at a time.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "terrane/base/image.h"
#include "terrane/base/result.h"
#include "terrane/gen/generators/biomes.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/map/map_tile.h"
#include "terrane/map/paint.h"
#include "terrane/map/surface_source.h"
#include "terrane/map/tint_field.h"

namespace terrane::map {

// Overlays of a map show heights and biomes as colors. Rows and columns are those of paint.h. The color of
// ground depends on its height above the sea alone: blue below it, the darker the deeper, then green, yellow,
// brown and white, and from 175 blocks on more and more violet.
Rgb heightColor(int z, int seaLevel);
// Returns the color of a biome by its name (gen/generators/biomes.h); gray for an unknown one.
Rgb biomeColor(std::string_view name);

// Blocks between the contour lines of a map, and between its thick lines; 0: there are none.
struct ContourSteps {
    int line = 16, thick = 0;

    bool operator==(const ContourSteps&) const = default;
};
// Returns those of a map of a level: 16, and in a tall world so many that a slope of 45° has at most a line
// every 8 pixels.
ContourSteps contourSteps(int level, world::Heights heights);

// Paints the height of the ground, under water too, with darker contour lines. Under a tree crown over water
// it paints the height of the water, since surfaces do not store its depth. The margin is kReliefMargin.
base::Image paintHeights(const PaintedArea& area, int seaLevel, ContourSteps steps = {});
// Paints biomes. `biomes` are the numbers of the rectangle's columns, x + width · y, and `colors` have one
// for each number. Each column is `scale`² pixels.
base::Image paintBiomes(const ColumnRect& rect, int scale, std::span<const std::uint8_t> biomes,
                        std::span<const Rgb> colors);

// Information about one column of level 0, shown for the column under the mouse pointer.
struct ColumnInfo {
    world::BlockId top = world::kAir;  // the topmost block; of plants only those that glow
    int topZ = 0;
    int depth = 0;           // blocks of liquid, if it is one
    std::string_view biome;  // empty where the generator has none
};

// Returns the number of columns at each side of a tile that change its image; of layers seen from above.
int marginOf(Layer layer);
// Returns the columns that a tile seen from above is painted from: its own and the margin.
ColumnRect columnsOf(const MapTile& tile);

// Returns the chunks whose surfaces a tile of a world of these heights shows; callers pass the edited ones to
// MapPainter::paint(). The result is empty for a tile of biomes, which edits do not change.
std::vector<world::ChunkPos> chunksFor(const MapTile& tile, world::Heights heights);
// Returns the tiles that show the chunk: of all layers but biomes, and of the zooms of the chunk's level.
std::vector<MapTile> tilesShowing(world::ChunkPos chunk, world::Heights heights);

class MapPainter {
  public:
    struct Parts {
        const gen::LevelGenerators& generators;
        const world::BlockRegistry& blocks;
        const world::TextureSource& textures;   // read by create() alone
        store::ReadableStore* store = nullptr;  // as SurfaceSource::Parts
        SurfaceCache* cache = nullptr;
        std::optional<gen::Biomes> biomes = {};
        int seaLevel = gen::kSeaLevel;  // of the world; for the colors of heights
    };
    // Fails if a texture cannot be read. All parts but the textures outlive this.
    [[nodiscard]] static base::Result<MapPainter> create(Parts parts);

    // Returns the digest of all inputs of images besides the land: colors of blocks, and the way of painting.
    std::uint64_t colorDigest() const;
    bool hasLayer(Layer layer) const { return layer != Layer::Biome || biomes_.has_value(); }
    world::Heights heights() const { return heights_; }  // of the world
    // Paints a PNG file. `edited`: the edited ones of chunksFor().
    [[nodiscard]] base::Result<std::string> paint(const MapTile& tile, std::span<const EditedChunk> edited);

    // Paints a rectangle by day, a pixel a column. Chunks of `edited` are read from the store.
    [[nodiscard]] base::Result<base::Image> paintArea(const ColumnRect& rect, const EditedPositions& edited);

    // Returns the digest of the surface of a chunk or tile, from `edited` or as generated. With equal digests
    // it looks the same from above.
    [[nodiscard]] base::Result<std::uint64_t> surfaceDigest(world::ChunkPos pos,
                                                            std::span<const EditedChunk> edited);

    // Returns information about the column at x, y (blocks). `edited` is its chunk if it is edited.
    [[nodiscard]] base::Result<ColumnInfo> columnInfo(std::int32_t x, std::int32_t y,
                                                      std::span<const EditedChunk> edited);

  private:
    MapPainter(Parts parts, MapColors colors);
    base::Result<base::Image> isometricImage(const MapTile& tile, std::span<const EditedChunk> edited);
    base::Result<base::Image> image(const MapTile& tile, std::span<const EditedChunk> edited);

    std::unique_ptr<SurfaceKinds> kinds_;  // the source refers to them
    world::Heights heights_;
    MapColors colors_;
    std::optional<gen::Biomes> biomes_;
    std::vector<Rgb> biomeColors_;  // by their numbers
    int seaLevel_;
    std::unique_ptr<SurfaceSource> surfaces_;
    std::unique_ptr<TintSource> tints_;
};

}  // namespace terrane::map
