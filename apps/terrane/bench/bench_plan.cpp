#include "apps/terrane/bench/bench_plan.h"

#include <algorithm>
#include <iterator>

namespace terrane::app {

BenchSettings quickSettings() {
    BenchSettings settings;
    settings.isQuick = true;
    settings.size = "320x180";
    settings.viewDistance = settings.farthest = 8;
    settings.frames = 3;
    settings.runs = 1;
    settings.flightSeconds = 4;
    return settings;
}

std::vector<Table> planTables(const BenchSettings& settings) {
    std::vector<Table> tables = {goalTable(settings)};
    for (auto part :
         {worldTables(settings), frameTables(settings), ownTables(settings), growthTables(settings)})
        std::ranges::move(part, std::back_inserter(tables));
    return tables;
}

}  // namespace terrane::app
