// Where a vertex of a quad reads the tint (tint_textures.h). Vertices select the levels: per fragment this would take
// more time than reading the textures, and software renderers execute every branch and a round of each loop. Needs
// frame_uniforms.glsl.
#include "terrane/shared/tint.h"

layout(std140, binding = kTintBinding) uniform TintBlock {
    TintFrame tintFrame;
};

struct TintPlace {
    vec4 at;       // texture coordinates in the finest level that reaches the quad, and in the next coarser one
    ivec2 levels;  // these levels; -1 for none
    float share;   // of the finer one
};

float blocksFromCamera(vec2 place) {
    vec2 away = abs(place - frame.cameraPosition.xy);
    return max(away.x, away.y);
}

// `quad` selects the levels, so that all vertices of a quad have the same. A level blends into the next one over its
// outer quarter. Places are in blocks from the corner of the camera's chunk.
TintPlace tintPlaceOf(vec2 quad, vec2 place) {
    float distance = blocksFromCamera(quad), reach = 1.0;
    TintPlace found = TintPlace(vec4(0.0), ivec2(-1), 0.0);
    for (int k = int(kTintLevels) - 1; k >= 0; --k) {
        vec4 level = tintFrame.levels[k];
        bool isReached = distance < level.w;
        vec4 at = vec4(level.xy + place * level.z, found.at.xy);
        found.at = isReached ? at : found.at;
        found.levels = isReached ? ivec2(k, found.levels.x) : found.levels;
        reach = isReached ? level.w : reach;
    }
    found.share = clamp(4.0 - 4.0 * blocksFromCamera(place) / reach, 0.0, 1.0);
    return found;
}
