#include "bench/land_figures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/bench_content.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/generators/continents.h"
#include "terrane/gen/generators/wilderness.h"

namespace terrane::bench {

using gen::Bits;

const std::vector<LandKind>& landKinds() {
    namespace continents = gen::continents;
    namespace wilderness = gen::wilderness;
    static const std::vector<LandKind> kinds = {
        {"continents",
         continents::kSea,
         static_cast<int>(continents::Biome::Reef) + 1,
         static_cast<int>(continents::Biome::Count),
         [](int b) { return continents::biomeName(static_cast<continents::Biome>(b)); },
         "mountains",
         {{"mountains", 0.05f}, {"volcanic", 0.05f}}},
        {"wilderness",
         wilderness::kSea,
         static_cast<int>(wilderness::Biome::Reef) + 1,
         static_cast<int>(wilderness::Biome::Count),
         [](int b) { return wilderness::biomeName(static_cast<wilderness::Biome>(b)); },
         "range",
         {{"range", 0.05f}, {"hilly", 0.3f}, {"canyon", 0.05f}, {"table", 0.05f}, {"volcanic", 0.05f}}}};
    return kinds;
}

LandColumns::LandColumns(const LandKind& kind, std::uint64_t seed, int level)
    : level_(static_cast<std::uint8_t>(level)),
      graph_(orExit(gen::makeGenerator(kind.generator, blocks(), level))) {
    std::erase_if(graph_.passes, [](const gen::PassGraph& pass) { return pass.is3D; });
    generator_ = std::make_unique<gen::Generator>(graph_, seed);
}

std::vector<std::vector<Bits>> LandColumns::square(const std::vector<std::string_view>& fields, int firstX,
                                                   int firstY, int tiles) const {
    const auto side = static_cast<std::size_t>(tiles) * 16;
    std::vector<std::vector<Bits>> squares(fields.size(), std::vector<Bits>(side * side));
    std::vector<std::uint32_t> numbers;
    for (const std::string_view field : fields) {
        const auto found = std::ranges::find(graph_.fields, field, &gen::FieldInfo::name);
        numbers.push_back(static_cast<std::uint32_t>(found - graph_.fields.begin()));
    }
    for (int k = 0; k < tiles * tiles; ++k) {
        const int tileX = k % tiles, tileY = k / tiles;
        // All fields of a tile at once: the generator keeps what passes have in common for a while.
        for (std::size_t f = 0; f < fields.size(); ++f) {
            const auto tile = generator_->columns({firstX + tileX, firstY + tileY, level_}, numbers[f]);
            for (std::size_t row = 0; row < 16; ++row) {
                const std::size_t to = static_cast<std::size_t>(tileX) * 16 +
                                       (static_cast<std::size_t>(tileY) * 16 + row) * side;
                std::copy_n(tile.begin() + static_cast<std::ptrdiff_t>(row) * 16, 16,
                            squares[f].begin() + static_cast<std::ptrdiff_t>(to));
            }
        }
    }
    return squares;
}

namespace {

std::vector<float> floatsOf(const std::vector<Bits>& values, float less = 0.0f) {
    std::vector<float> floats(values.size());
    std::ranges::transform(values, floats.begin(), [less](Bits b) { return gen::asFloat(b) - less; });
    return floats;
}

// Correlations of heights along one axis, by lag / kLagStep, up to half the side.
std::vector<double> correlations(const std::vector<float>& heights, std::size_t along, std::size_t across) {
    const auto side = static_cast<std::size_t>(kLandTiles) * 16;
    const double count = static_cast<double>(heights.size());
    const double mean = std::accumulate(heights.begin(), heights.end(), 0.0) / count;
    double variance = 0;
    for (const float h : heights) variance += (h - mean) * (h - mean) / count;
    std::vector<double> result;
    for (std::size_t lag = 0; lag <= side / 2; lag += kLagStep) {
        double sum = 0, pairs = 0;
        for (std::size_t b = 0; b < side; b += 2) {
            for (std::size_t a = 0; a + lag < side; ++a) {
                const std::size_t at = a * along + b * across;
                sum += (heights[at] - mean) * (heights[at + lag * along] - mean);
                ++pairs;
            }
        }
        result.push_back(sum / pairs / variance);
    }
    return result;
}

void addCorrelations(LandStatistics& s, const std::vector<float>& heights) {
    constexpr std::size_t kSide = std::size_t{kLandTiles} * 16;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto now = axis == 0 ? correlations(heights, 1, kSide) : correlations(heights, kSide, 1);
        s.correlation[axis].resize(now.size());
        for (std::size_t k = 0; k < now.size(); ++k) {
            s.correlation[axis][k] += now[k];
            if (k >= kFarLag / kLagStep)
                s.largestCorrelation = std::max(s.largestCorrelation, std::abs(now[k]));
        }
    }
}

}  // namespace

void addLand(LandStatistics& s, const LandKind& kind, std::uint64_t seed) {
    const LandColumns columns(kind, seed, kLandLevel);
    const auto fields = columns.square({"biome", "height"}, -kLandTiles / 2, -kLandTiles / 2, kLandTiles);
    s.biomes.resize(static_cast<std::size_t>(kind.biomes));
    for (const Bits biome : fields[0]) {
        s.biomes[biome] += 1;
        s.columns += 1;
        s.land += static_cast<int>(biome) >= kind.firstLandBiome;
    }
    const std::vector<float> heights = floatsOf(fields[1], kind.sea);
    for (const float h : heights) s.heights[static_cast<int>(std::floor(h / kHeightClass))] += 1;
    addCorrelations(s, heights);
    s.seeds += 1;
}

namespace {

// The largest value of each window of size² values, a power of two, at the window's first corner. Values
// beyond the far edges are missing.
std::vector<float> windowMaxima(std::vector<float> values, int side, int size) {
    for (const int along : {1, side}) {
        const int across = along == 1 ? side : 1;
        for (int reach = 1; reach < size; reach *= 2) {
            for (int b = 0; b < side; ++b) {
                for (int a = 0; a + reach < side; ++a) {
                    float& here = values[static_cast<std::size_t>(a * along + b * across)];
                    here = std::max(here, values[static_cast<std::size_t>((a + reach) * along + b * across)]);
                }
            }
        }
    }
    return values;
}

std::vector<float> negated(std::vector<float> values) {
    for (float& v : values) v = -v;
    return values;
}

constexpr int kReliefSide = kReliefTiles * 16;
constexpr int kReliefWindow = 1024 >> kReliefLevel;  // columns: 1 km
constexpr int kPeakWindow = 4096 >> kReliefLevel;    // 2 km to all sides

struct ReliefFields {
    std::vector<float> heights;  // of the ground; of the sea where it is below
    std::vector<float> range;
    std::vector<float> isOther;  // 1: land that is no lowland
};

ReliefFields reliefFields(const LandKind& kind, std::uint64_t seed) {
    std::vector<std::string_view> names = {"height", kind.range};
    for (const FieldLimit& flat : kind.flat) names.push_back(flat.field);
    const LandColumns columns(kind, seed, kReliefLevel);
    const auto fields = columns.square(names, -kReliefTiles / 2, -kReliefTiles / 2, kReliefTiles);
    ReliefFields f = {floatsOf(fields[0], kind.sea), floatsOf(fields[1]),
                      std::vector<float>(fields[0].size(), 0.0f)};
    for (float& h : f.heights) h = std::max(h, 0.0f);
    for (std::size_t n = 0; n < kind.flat.size(); ++n) {
        for (std::size_t k = 0; k < f.heights.size(); ++k) {
            const bool isAbove = gen::asFloat(fields[n + 2][k]) >= kind.flat[n].limit;
            if (isAbove && f.heights[k] > 0) f.isOther[k] = 1;
        }
    }
    return f;
}

// The highest columns within 2 km of themselves, in ranges.
void addPeaks(LandStatistics& s, const ReliefFields& f) {
    const std::vector<float> highest = windowMaxima(f.heights, kReliefSide, kPeakWindow);
    for (int y = 0; y + kPeakWindow < kReliefSide; ++y) {
        for (int x = 0; x + kPeakWindow < kReliefSide; ++x) {
            const auto middle =
                static_cast<std::size_t>(x + kPeakWindow / 2 + (y + kPeakWindow / 2) * kReliefSide);
            const float height = f.heights[middle];
            if (f.range[middle] > 0.5f && height == highest[static_cast<std::size_t>(x + y * kReliefSide)])
                s.peaks.push_back(height);
        }
    }
}

}  // namespace

void addRelief(LandStatistics& s, const LandKind& kind, std::uint64_t seed) {
    const ReliefFields f = reliefFields(kind, seed);
    const std::vector<float> highest = windowMaxima(f.heights, kReliefSide, kReliefWindow);
    const std::vector<float> lowest = negated(windowMaxima(negated(f.heights), kReliefSide, kReliefWindow));
    const std::vector<float> isOther = windowMaxima(f.isOther, kReliefSide, kReliefWindow);
    for (int y = 0; y + kReliefWindow < kReliefSide; y += 4) {
        for (int x = 0; x + kReliefWindow < kReliefSide; x += 4) {
            const auto at = static_cast<std::size_t>(x + y * kReliefSide);
            const auto middle =
                static_cast<std::size_t>(x + kReliefWindow / 2 + (y + kReliefWindow / 2) * kReliefSide);
            if (f.heights[middle] <= 0) continue;
            s.places += 1;
            const float relief = highest[at] - lowest[at];
            if (f.range[middle] > 0.5f) s.rangeRelief.push_back(relief);
            if (f.isOther[middle] == 0) s.lowlandRelief.push_back(relief);
            if (isOther[at] == 0) s.wideLowlandRelief.push_back(relief);
        }
    }
    addPeaks(s, f);
}

namespace {

constexpr int kGroundTiles = 24, kGroundSide = kGroundTiles * 16;
constexpr std::array<std::array<int, 2>, 12> kGroundPlaces = {{{-300, -300},
                                                               {-100, -100},
                                                               {60, 60},
                                                               {250, 250},
                                                               {-300, 250},
                                                               {-100, 60},
                                                               {60, -100},
                                                               {250, -300},
                                                               {0, 400},
                                                               {400, 0},
                                                               {-420, 0},
                                                               {0, -420}}};

// Adds the straight pieces of borders between different values, along either axis.
void addBorders(Borders& borders, const std::vector<Bits>& values, StraightPiece corner) {
    for (const int along : {1, kGroundSide}) {
        const int across = along == 1 ? kGroundSide : 1;
        for (int a = 0; a + 1 < kGroundSide; ++a) {
            int run = 0;
            for (int b = 0; b < kGroundSide; ++b) {
                const int at = a * across + b * along;
                const bool isBorder =
                    values[static_cast<std::size_t>(at)] != values[static_cast<std::size_t>(at + across)];
                run = isBorder ? run + 1 : 0;
                if (run == kMaxStraight + 1) ++borders.tooLong;
                if (run <= borders.longest.blocks) continue;
                const int first = at - (run - 1) * along;
                borders.longest = {run, corner.x + first % kGroundSide, corner.y + first / kGroundSide,
                                   corner.seed};
            }
        }
    }
}

void addSlopes(LandStatistics& s, const LandKind& kind, const std::vector<Bits>& biomes,
               const std::vector<float>& heights) {
    constexpr std::array<float, 4> kAbove = {0.5f, 1, 2, 4};
    for (int k = 0; k + kGroundSide < kGroundSide * kGroundSide; ++k) {
        const auto at = static_cast<std::size_t>(k);
        if (static_cast<int>(biomes[at]) < kind.firstLandBiome || k % kGroundSide == kGroundSide - 1)
            continue;  // the next one is of another row
        const float slope =
            std::hypot(heights[at + 1] - heights[at], heights[at + kGroundSide] - heights[at]);
        for (std::size_t n = 0; n < kAbove.size(); ++n) s.slopes[n] += slope > kAbove[n];
        s.slopes[4] += 1;
    }
}

}  // namespace

void addGround(LandStatistics& s, const LandKind& kind, std::uint64_t seed) {
    const LandColumns columns(kind, seed, 0);
    for (const auto& [x, y] : kGroundPlaces) {
        const auto fields = columns.square({"biome", "height"}, x, y, kGroundTiles);
        const std::vector<float> heights = floatsOf(fields[1], kind.sea);
        const StraightPiece corner = {0, x * 16, y * 16, seed};
        addBorders(s.biomeBorders, fields[0], corner);
        for (const float contour : {20.0f, 100.0f, 300.0f, 600.0f}) {
            std::vector<Bits> isAbove(heights.size());
            std::ranges::transform(heights, isAbove.begin(), [contour](float h) { return h > contour; });
            addBorders(s.contours, isAbove, corner);
        }
        addSlopes(s, kind, fields[0], heights);
    }
}

double earthShare(int from) {
    // Areas of Earth in 1,000 km² by 500 m of height, from −9,500 m and from 0 on: S. Dutch, Global
    // Topographic Summary, University of Wisconsin – Green Bay, from a grid of 5 minutes. The ice counts as
    // land, as in the hypsographic curve of ETOPO1 (B. W. Eakins and G. F. Sharman, NOAA, 2012).
    static const std::vector<double> kSeaAreas = {12,    41,    50,    114,   155,   338,   1686,
                                                  20405, 48471, 60337, 58839, 49100, 31148, 18573,
                                                  10669, 8457,  6547,  6991,  36618};
    static const std::vector<double> kLandAreas = {80780, 29530, 15726, 7794, 5283, 4649, 3351, 1691,
                                                   749,   899,   877,   167,  18,   0.9,  0.15, 0.07};
    const bool isLand = from >= 0;
    const std::vector<double>& areas = isLand ? kLandAreas : kSeaAreas;
    const double metres = isLand ? kEarthLand : kEarthSea, lowest = isLand ? 0.0 : -9500.0;
    const double low = from * metres, high = (from + kHeightClass) * metres;
    double area = 0;
    for (std::size_t k = 0; k < areas.size(); ++k) {
        const double bottom = lowest + 500.0 * static_cast<double>(k);
        area += areas[k] * std::max(0.0, std::min(high, bottom + 500) - std::max(low, bottom)) / 500;
    }
    return 100 * area / std::accumulate(areas.begin(), areas.end(), 0.0);
}

float percentile(std::vector<float>& values, double share) {
    if (values.empty()) return 0.0f;
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace terrane::bench
