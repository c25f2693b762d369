// Binding numbers of buffers and textures, the same in C++ and in shaders.
#ifndef TERRANE_SHARED_BINDINGS_H
#define TERRANE_SHARED_BINDINGS_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Uniform buffers
const uint kFrameBinding = 0u;

// Storage buffers
const uint kQuadsBinding = 0u;
const uint kShapeFacesBinding = 1u;
const uint kMaterialsBinding = 2u;
const uint kDrawsBinding = 3u;

// Texture units
const uint kBlockTexturesUnit = 0u;
const uint kSceneColorUnit = 1u;
const uint kLightGridUnit = 2u;
const uint kLightPoolUnit = 3u;

SHARED_END
#endif
