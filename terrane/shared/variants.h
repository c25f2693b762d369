// The choices of shader variants (render/frame/variants.h): macros, for the shaders' preprocessor.
#ifndef TERRANE_SHARED_VARIANTS_H
#define TERRANE_SHARED_VARIANTS_H

// PASS
#define PASS_SURFACES 0
#define PASS_LAYERS 1
#define PASS_SHADOWS 2
#define PASS_CORNERS 3
#define PASS_RAYS 4

// RAY_LAYER: the surfaces behind all blended faces; the first layer of these; the next one
#define RAY_SURFACES 0
#define RAY_FIRST_LAYER 1
#define RAY_NEXT_LAYER 2

// ALPHA_CLASS
#define ALPHA_OPAQUE 0
#define ALPHA_TESTED 1
#define ALPHA_BLENDED 2

// SHADOW
#define SHADOW_NONE 0
#define SHADOW_HARD 1
#define SHADOW_SOFT 2
#define SHADOW_RAYS 3

// LIGHT: far away, in air, LIGHT_SIMPLE reads one voxel
#define LIGHT_CLASSIC 0
#define LIGHT_SMOOTH 1
#define LIGHT_SIMPLE 2

// MASK: the pixels in which any sample has a surface; shows the sky or may fade into it; has a layer
// RESIZING: of the image, to that of the screen
#define RESIZE_LINEAR 0
#define RESIZE_NEAREST 1
#define RESIZE_EDGES 2
#define RESIZE_SHARPEN 3

#define MASK_SURFACES 0
#define MASK_SKY 1
#define MASK_LAYERS 2

// AXIS
#define AXIS_X 0
#define AXIS_Y 1

#endif
