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

// How many columns around what is painted an area has to have: relief is the slope of the columns around,
// lamps shine as far.
constexpr int kReliefMargin = 2, kLampMargin = 16;

// What is painted: the columns of an area but for `margin` at each side, each as `scale`² pixels (1, 2 or 4).
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
