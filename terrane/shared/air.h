// Uniforms of the air, set once a frame. world/sky/air.h has the model and its constants.
#ifndef TERRANE_SHARED_AIR_H
#define TERRANE_SHARED_AIR_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// The table of the sky (world/sky/environment.h): columns by azimuth to the light, rows by elevation.
const uint kSkyTableColumns = 64u;
const uint kSkyTableRows = 32u;

struct AirFrame {
    // x, y: level direction toward the light, unit length; z: scale of the table; w: optical depth of haze at
    // levels.x, as in depth.y.
    vec4 lightAzimuth;
    vec4 aureole;  // narrow glow around the light; w: its sharpness
    // x, y: optical depth of a block at the camera's altitude in powers of ½: of molecules for red, and of
    // haze for all colors. z: 1 / scale height of the haze. w: share by which the mean density of molecules
    // on the way decreases with each block of rise.
    vec4 depth;
    vec4 levels;  // x: z below which haze is no denser; y: z of the clouds' plane
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(AirFrame) == 4 * 16);
}  // namespace terrane::shared
#endif
#endif
