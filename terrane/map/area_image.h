// An image of any area of a map, painted in pieces by many threads.
#pragma once

#include <functional>

#include "terrane/base/job_system.h"
#include "terrane/map/map_painter.h"

namespace terrane::map {

// Paints by day, a pixel a column, north up. It calls `shouldContinue` after each strip with the number of
// painted rows; false ends it with an error.
[[nodiscard]] base::Result<base::Image> drawArea(MapPainter& painter, const ColumnRect& rect,
                                                 const EditedPositions& edited, base::JobSystem& jobs,
                                                 const std::function<bool(int rows)>& shouldContinue);

}  // namespace terrane::map
