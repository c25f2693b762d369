// Depth of the surfaces whose ambient occlusion is computed: the opaque ones or, with NEAREST_LAYER, those of the
// nearest blended layer. Needs gbuffer_read.glsl.
#if NEAREST_LAYER == 1
#if MSAA_SAMPLES > 1
layout(binding = kTransparencyColorUnit) uniform sampler2DMS nearestLayer;
layout(binding = kTransparencyDepthUnit) uniform sampler2DMS nearestLayerDepth;
#else
layout(binding = kTransparencyColorUnit) uniform sampler2D nearestLayer;
layout(binding = kTransparencyDepthUnit) uniform sampler2D nearestLayerDepth;
#endif

// A layer without a face has the depth of the opaque surface.
float nearestDepthAt(ivec2 pixel) {
    return texelFetch(nearestLayerDepth, pixel, 0).r;
}
bool isDrawnAt(ivec2 pixel) {
    return nearestDepthAt(pixel) > depthAt(pixel, 0);
}
#else
float nearestDepthAt(ivec2 pixel) {
    return depthAt(pixel, 0);
}
bool isDrawnAt(ivec2 pixel) {
    return true;
}
#endif

const float kOcclusionReach = 96.0;  // blocks along the view
