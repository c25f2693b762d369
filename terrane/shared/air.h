// What the shaders know of the air in a frame. Its constants are those of world/air.h.
#ifndef TERRANE_SHARED_AIR_H
#define TERRANE_SHARED_AIR_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// The table of the sky (world/sky_light.h): columns by azimuth to the light, rows by elevation.
const uint kSkyTableColumns = 64u;
const uint kSkyTableRows = 32u;

struct AirFrame {
    vec4 lightAzimuth;  // x, y: level direction toward the light, unit length; z: scale of the table; w: 0
    vec4 aureole;       // narrow glow around the light; w: its sharpness
    // Powers of ½ a block at the camera's altitude that are left of red, and of all colors in haze; 1 / scale
    // height of the haze, and by how much a block of rise thins the molecules on the way to it.
    vec4 depth;
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(AirFrame) == 3 * 16);
}  // namespace terrane::shared
#endif
#endif
