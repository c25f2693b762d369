// Binding numbers of buffers and textures, the same in C++ and in shaders.
#ifndef TERRANE_SHARED_BINDINGS_H
#define TERRANE_SHARED_BINDINGS_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Uniform buffers
const uint kFrameBinding = 0u;
const uint kCullBinding = 1u;
const uint kTintBinding = 2u;
const uint kLandBinding = 3u;
const uint kShadowBinding = 4u;
const uint kShadowDrawBinding = 5u;
const uint kAirBinding = 6u;
const uint kFiguresBinding = 7u;

// Storage buffers
const uint kMeshSectionsBinding = 0u;
const uint kMeshSectionOrderBinding = 1u;
const uint kVisibleBinding = 2u;
const uint kCommandsBinding = 3u;
const uint kCountsBinding = 4u;
const uint kVisibleLastFrameBinding = 5u;
const uint kTestedMeshSectionsBinding = 6u;
const uint kQuadsBinding = 7u;
const uint kListedQuadsBinding = 2u;  // not with kVisibleBinding, which has the same number
const uint kRayWordsBinding = 0u;     // of rays, in passes without culling: ray_scene.h
const uint kRayBlocksBinding = 1u;    // ray_blocks.h
const uint kRayTypesBinding = 2u;
const uint kRayFormsBinding = 3u;
const uint kDrawRecordsBinding = 6u;  // not with kTestedMeshSectionsBinding: OpenGL guarantees 8 bindings

// Texture units
const uint kBlockTexturesUnit = 0u;
const uint kSceneUnit = 1u;
const uint kLightGridUnit = 2u;
const uint kLightPoolUnit = 3u;
const uint kGBufferUnit = 4u;    // the packed G-buffer
const uint kDepthUnit = 5u;      // its depth
const uint kShadowUnit = 6u;     // compared
const uint kSkyNoiseUnit = 7u;   // tiling noise, for clouds and waves
const uint kOcclusionUnit = 8u;  // ambient occlusion
const uint kGodRaysUnit = 9u;
const uint kDepthOfFieldUnit = 10u;
const uint kTransparencyColorUnit = 11u;  // three units: layers from the nearest
const uint kTransparencyDepthUnit = 14u;  // three units
const uint kHiZUnit = 17u;                // Hi-Z
const uint kQuadsUnit = 18u;              // buffers as textures
const uint kShapeFacesUnit = 19u;
const uint kMaterialsUnit = 20u;
const uint kSmoothTexturesUnit = 21u;  // the block textures with either sampler: FACE_SAMPLING
const uint kNearestTexturesUnit = 22u;
const uint kTintUnit = 23u;
const uint kLandShadowUnit = 24u;
const uint kLandGroundUnit = 25u;
const uint kShadowDepthsUnit = 26u;  // the maps of kShadowUnit without comparison
const uint kLightEntriesUnit = 27u;
const uint kSkyTableUnit = 28u;
const uint kMilkyWayUnit = 29u;
const uint kListedQuadsUnit = 30u;  // a buffer as a texture
const uint kQuadLightUnit = 31u;    // a buffer as a texture, beside kQuadsUnit
const uint kBloomUnit = 32u;

// Vertex attributes
const uint kDrawRecordAttribute = 0u;  // DrawRecord, by the base instance

// Image units
const uint kHiZFromImage = 0u;
const uint kHiZToImage = 1u;

// Plain uniforms
const uint kArenaLocation = 0u;      // quad_cull.comp.glsl and quad_list.comp.glsl
const uint kListedBitLocation = 1u;  // quad_list.comp.glsl

SHARED_END
#endif
