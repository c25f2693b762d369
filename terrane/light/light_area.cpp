#include "terrane/light/light_area.h"

#include <algorithm>

#include "terrane/base/result.h"

namespace terrane::light {

namespace {

// Results of stage 1 for the rows y − 1, y and y + 1 of chunks.
class LocalRows {
  public:
    LocalRows(const LightArea& area, const LightTable& table, LightScratch& scratch)
        : area_(area), table_(table), scratch_(scratch) {}

    void solve(int y) {
        auto& row = rows_[static_cast<std::size_t>(y % 3)];
        row.clear();
        if (y >= area_.chunksY) return;
        for (int x = 0; x < area_.chunksX; ++x)
            row.push_back(solveLocal(area_.chunk(x, y), table_, scratch_));
    }
    LocalLightNeighborhood around(int x, int y) const {
        LocalLightNeighborhood result{};
        for (int k = 0; k < kFieldChunks; ++k) {
            const int cx = x + k % kFieldSide - 1, cy = y + k / kFieldSide - 1;
            if (cx < 0 || cy < 0 || cx >= area_.chunksX || cy >= area_.chunksY) continue;
            result[static_cast<std::size_t>(k)] =
                &rows_[static_cast<std::size_t>(cy % 3)][static_cast<std::size_t>(cx)];
        }
        return result;
    }

  private:
    const LightArea& area_;
    const LightTable& table_;
    LightScratch& scratch_;
    std::array<std::vector<LocalLight>, 3> rows_;
};

}  // namespace

void requireWhole(const LightArea& area) {
    const bool hasSize = area.chunksX > 0 && area.chunksY > 0;
    const auto count =
        hasSize ? static_cast<std::size_t>(area.chunksX) * static_cast<std::size_t>(area.chunksY) : 0;
    base::require(hasSize && area.chunks.size() == count && std::ranges::count(area.chunks, nullptr) == 0,
                  "LightArea: chunks are chunksX × chunksY, at least one, none null");
}

std::vector<ChunkLight> lightArea(const LightArea& area, const LightTable& table) {
    requireWhole(area);
    std::vector<ChunkLight> lights;
    lights.reserve(area.chunks.size());
    LightScratch scratch;
    LocalRows rows(area, table, scratch);
    rows.solve(0);
    for (int y = 0; y < area.chunksY; ++y) {
        rows.solve(y + 1);
        for (int x = 0; x < area.chunksX; ++x) lights.push_back(lightChunk(rows.around(x, y), scratch));
    }
    return lights;
}

namespace {

class CpuSolver : public AreaSolver {
  public:
    explicit CpuSolver(const LightTable& table) : table_(table) {}

    std::vector<ChunkLight> solve(const LightArea& area) override { return lightArea(area, table_); }
    std::string_view backend() const override { return "cpu"; }

  private:
    const LightTable& table_;
};

}  // namespace

std::unique_ptr<AreaSolver> makeCpuSolver(const LightTable& table) {
    return std::make_unique<CpuSolver>(table);
}

}  // namespace terrane::light
