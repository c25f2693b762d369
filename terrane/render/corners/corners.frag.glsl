// Draws quads that are shaded at their corners: corners.vert.glsl. ALPHA_CLASS: opaque, tested or blended.
#include "terrane/shared/bindings.h"
#include "terrane/shared/variants.h"

layout(binding = kBlockTexturesUnit) uniform sampler2DArray blockTextures;

layout(location = 0) in vec3 inTexel;
layout(location = 1) in vec3 inScale;
layout(location = 2) in vec3 inScaleOfAlpha;
layout(location = 3) in vec3 inAdded;
#if ALPHA_CLASS == ALPHA_TESTED
layout(location = 4) flat in float inMinAlpha;
#elif ALPHA_CLASS == ALPHA_BLENDED
layout(location = 4) in vec2 inAlpha;
#endif
layout(location = 0) out vec4 outColor;

void main() {
    vec4 texel = texture(blockTextures, inTexel);
#if ALPHA_CLASS == ALPHA_TESTED
    if (texel.a < inMinAlpha) discard;
#endif
    outColor = vec4(texel.rgb * mix(inScale, inScaleOfAlpha, texel.a) + inAdded, 1.0);
#if ALPHA_CLASS == ALPHA_BLENDED
    outColor = clamp(outColor, 0.0, 1.0) * clamp(texel.a * inAlpha.x + inAlpha.y, 0.0, 1.0);
#endif
}
