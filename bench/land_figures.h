// Statistics of the land that a generator makes, from its fields by column: heights, slopes, relief, borders.
// Used by bench_land. Heights are blocks above the sea.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "terrane/gen/generator.h"

namespace terrane::bench {

struct FieldLimit {
    std::string_view field;
    float limit;
};

// A generator with land and sea, and the names of its fields.
struct LandKind {
    std::string_view generator;
    float sea;                   // z of the highest water of the sea
    int firstLandBiome, biomes;  // numbers of biomes: those of the sea come first
    const char* (*biomeName)(int);
    std::string_view range;        // this field is above 0.5 in ranges
    std::vector<FieldLimit> flat;  // these fields are below their limits in lowlands
};
const std::vector<LandKind>& landKinds();

// Fields of the 2D passes of a generator at one level.
class LandColumns {
  public:
    LandColumns(const LandKind& kind, std::uint64_t seed, int level);

    // Returns a square of columns of each field, x + side · y: `tiles` tiles along x and y from the first
    // one.
    std::vector<std::vector<gen::Bits>> square(const std::vector<std::string_view>& fields, int firstX,
                                               int firstY, int tiles) const;

  private:
    std::uint8_t level_;
    gen::GeneratorGraph graph_;
    std::unique_ptr<gen::Generator> generator_;
};

// A straight piece of a border along either axis, and where it begins.
struct StraightPiece {
    int blocks = 0, x = 0, y = 0;
    std::uint64_t seed = 0;
};

struct Borders {
    StraightPiece longest;
    long tooLong = 0;  // pieces longer than kMaxStraight
};
constexpr int kMaxStraight = 30;  // blocks

// Sums over seeds.
struct LandStatistics {
    // Of columns 64 blocks wide.
    double columns = 0, land = 0;
    std::vector<double> biomes;                      // columns by number of the biome
    std::map<int, double> heights;                   // columns by height / kHeightClass, rounded down
    std::array<std::vector<double>, 2> correlation;  // along x and y, by lag / kLagStep
    double seeds = 0, largestCorrelation = 0;        // of one seed, beyond kFarLag
    // Of columns 16 blocks wide: blocks, by place on land.
    double places = 0;
    std::vector<float> rangeRelief, lowlandRelief, wideLowlandRelief, peaks;
    // Of columns 1 block wide.
    std::array<double, 5> slopes{};  // land columns with slopes above 0.5, 1, 2, 4, and all
    Borders biomeBorders, contours;
};

constexpr int kLandLevel = 6, kLandTiles = 64;       // 65.5 km along x and y: 4,295 km² a seed
constexpr int kReliefLevel = 4, kReliefTiles = 128;  // 32.8 km, 1,074 km²
constexpr int kHeightClass = 50;                     // blocks
constexpr int kLagStep = 4, kFarLag = 192;           // columns: 256 blocks, 12.3 km

void addLand(LandStatistics& s, const LandKind& kind, std::uint64_t seed);
void addRelief(LandStatistics& s, const LandKind& kind, std::uint64_t seed);
void addGround(LandStatistics& s, const LandKind& kind, std::uint64_t seed);

// Earth's share of the area, in percent of its land or of its sea, of the class of heights `from` … `from` +
// kHeightClass, when a block is kEarthLand metres above the sea and kEarthSea below.
double earthShare(int from);
// 1,700 and −400 blocks are then about the heights of the highest mountains and of the deep sea floor.
constexpr double kEarthLand = 5.0, kEarthSea = 15.0;

// The value that this share of the values is below. Sorts the values.
float percentile(std::vector<float>& values, double share);

}  // namespace terrane::bench
