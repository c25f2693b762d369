// The grid of cells over the screen at which the sky is computed: render/corners/corner_sky.h.
#ifndef TERRANE_SHARED_SKY_GRID_H
#define TERRANE_SHARED_SKY_GRID_H

#include "terrane/shared/language.h"

SHARED_BEGIN

const uint kSkyGridColumns = 40u;
const uint kSkyGridRows = 48u;
const uint kSkyGridVertices = 11520u;  // six for each cell

SHARED_END

#ifdef __cplusplus
static_assert(terrane::shared::kSkyGridVertices ==
              6 * terrane::shared::kSkyGridColumns * terrane::shared::kSkyGridRows);
#endif
#endif
