// Images of surfaces seen from above: by day with relief, by night with lamps. Any thread.
//
// North is up: the first row of pixels is the one with the smallest y, the first pixel of a row the one with
// the largest x.
#pragma once

#include <span>

#include "terrane/base/image.h"
#include "terrane/map/map_colors.h"
#include "terrane/map/surface_source.h"
#include "terrane/map/tint_field.h"

namespace terrane::map {

// Columns that an area needs around the painted ones: relief is the slope of the columns around, and lamps
// shine this far.
constexpr int kReliefMargin = 2, kLampMargin = 16;

// The columns to paint: those of an area without `margin` columns at each side, each as `scale`² pixels (1, 2
// or 4).
struct PaintedArea {
    const SurfaceArea& surfaces;
    const TintField& tint;
    int margin = kReliefMargin;
    int scale = 1;
};

base::Image paintDay(const PaintedArea& area, const MapColors& colors);
// The margin is kLampMargin.
base::Image paintNight(const PaintedArea& area, const MapColors& colors);

}  // namespace terrane::map
