// Tells fragments of a quad where to read the tint (tint_textures.h). Vertices select the levels: per fragment this would take
// more time than reading the textures, and software renderers execute every branch and a round of each loop. Needs
// frame_uniforms.glsl.
#include "terrane/shared/tint.h"

layout(std140, binding = kTintBinding) uniform TintBlock {
    TintFrame tintFrame;
};

#if PASS == PASS_CORNERS || PASS == PASS_RAYS
vec4 outTintAt;
float outTintShare;
ivec2 outTintLevels;
#else
layout(location = 3) out vec4 outTintAt;  // texture coordinates in a level and in the next coarser one
layout(location = 4) out float outTintShare;  // of the finer level
layout(location = 5) flat out ivec2 outTintLevels;  // -1 for none
#endif

float blocksFromCamera(vec2 place) {
    vec2 away = abs(place - frame.cameraPosition.xy);
    return max(away.x, away.y);
}

// The finest level that reaches `quad` is read, so all vertices of a quad have the same. It blends into the next coarser
// one over its outer quarter. Places are in blocks from the corner of the camera's chunk.
void setTintPlace(vec2 quad, vec2 place) {
    float distance = blocksFromCamera(quad), reach = 1.0;
    outTintAt = vec4(0.0);
    outTintLevels = ivec2(-1);
    for (int k = int(kTintLevels) - 1; k >= 0; --k) {
        vec4 level = tintFrame.levels[k];
        bool isReached = distance < level.w;
        outTintAt = isReached ? vec4(level.xy + place * level.z, outTintAt.xy) : outTintAt;
        outTintLevels = isReached ? ivec2(k, outTintLevels.x) : outTintLevels;
        reach = isReached ? level.w : reach;
    }
    outTintShare = clamp(4.0 - 4.0 * blocksFromCamera(place) / reach, 0.0, 1.0);
}
