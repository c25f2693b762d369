// Binding numbers of buffers and textures, the same in C++ and in shaders.
#ifndef TERRANE_SHARED_BINDINGS_H
#define TERRANE_SHARED_BINDINGS_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Uniform buffers
const uint kFrameBinding = 0u;
const uint kCullBinding = 1u;

// Storage buffers
const uint kRegionsBinding = 0u;
const uint kRegionOrderBinding = 1u;
const uint kVisibleBinding = 2u;
const uint kCommandsBinding = 3u;
const uint kCountsBinding = 4u;
const uint kSeenBinding = 5u;

// Texture units
const uint kBlockTexturesUnit = 0u;
const uint kSceneUnit = 1u;
const uint kLightGridUnit = 2u;
const uint kLightPoolUnit = 3u;
const uint kSurfaceUnit = 4u;    // the G-buffer's word
const uint kDepthUnit = 5u;      // its depth
const uint kShadowUnit = 6u;     // compared
const uint kSkyNoiseUnit = 7u;   // tiling noise, for clouds and waves
const uint kOcclusionUnit = 8u;  // ambient occlusion
const uint kGodRaysUnit = 9u;
const uint kBlurUnit = 10u;
const uint kLayerColorUnit = 11u;  // three units: layers from the nearest
const uint kLayerDepthUnit = 14u;  // three units
const uint kPyramidUnit = 17u;     // of depths
const uint kQuadsUnit = 18u;       // buffers as textures
const uint kShapeFacesUnit = 19u;
const uint kMaterialsUnit = 20u;

// Vertex attributes
const uint kRegionChunkAttribute = 0u;  // chunk and level of a draw's region, by the base instance

// Image units
const uint kPyramidFromImage = 0u;
const uint kPyramidToImage = 1u;

SHARED_END
#endif
