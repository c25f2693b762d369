#include "terrane/light/area_solver.h"

namespace terrane::light {
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
