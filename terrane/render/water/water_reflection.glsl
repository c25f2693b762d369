// Reflections of the shore in water: a march over the depth of opaque surfaces, in screen space. Needs
// frame_uniforms.glsl, gbuffer_read.glsl and the functions of transparency.frag.glsl's layers.
// The scene is read while layers are drawn over it: only pixels without any layer, which are not written (OpenGL 4.5,
// section 9.3, "Rendering Feedback Loops").
layout(binding = kSceneUnit) uniform sampler2D scene;

const int kMarchSteps = 20, kRefineSteps = 5;
const float kLeastMirror = 0.04;  // weaker reflections are invisible

ivec2 pixelAt(vec2 screen) {
    return ivec2(clamp((0.5 + 0.5 * screen) * frame.viewportSize, vec2(0.0), frame.viewportSize - 1.0));
}

bool hasLayer(ivec2 pixel) {
    bool isAny = false;
    for (int k = 0; k < MSAA_SAMPLES; ++k) isAny = isAny || texelFetch(layerDepths[0], pixel, k).r > depthAt(pixel, k);
    return isAny;
}

bool isBehind(vec3 at) {
    return at.z < depthAt(pixelAt(at.xy), 0);
}

// Whether a surface lies between two points of the ray. It is passed far behind near surfaces.
bool isHitBetween(vec3 before, vec3 at) {
    float depth = depthAt(pixelAt(at.xy), 0);
    float seen = blocksOfDepth(depth), blocks = blocksOfDepth(at.z);
    return at.z < depth && blocks - seen < 1.0 + 0.05 * seen + abs(blocks - blocksOfDepth(before.z));
}

// Color of a surface, and its share: 0 in water and at the edge of the image. `at`: of the ray, at the surface. Reflections
// lie below what they show, so they end at the upper edge, and fade there.
vec4 seenAt(vec3 at, vec2 onScreen) {
    // Pixels at the shore line have both land and water: the pixels above are read.
    ivec2 pixel = pixelAt(at.xy), up = ivec2(sign(onScreen));
    for (int k = 0; k < 3 && hasLayer(pixel); ++k) pixel = clamp(pixel + up, ivec2(0), ivec2(frame.viewportSize) - 1);
    vec2 edge = 1.0 - smoothstep(vec2(0.96, 0.8), vec2(1.0), abs(at.xy));
    return hasLayer(pixel) ? vec4(0.0) : vec4(texelFetch(scene, pixel, 0).rgb, edge.x * edge.y);
}

// Screen positions and depths are linear along the ray (depth is near / distance), up to its end at infinity.
vec4 shoreReflection(vec3 position, vec3 direction, float mirror) {
    vec4 from = frame.viewProjection * vec4(position, 1.0), along = frame.viewProjection * vec4(direction, 0.0);
    vec3 start = from.xyz / from.w, way = along.xyz / max(along.w, 0.02) - start;
    vec2 toEdge = (1.0 - sign(way.xy) * start.xy) / max(abs(way.xy), 1e-5);
    way *= clamp(min(toEdge.x, toEdge.y), 0.0, 1.0);
    float before = 0.0;
    int count = mirror > kLeastMirror && along.w > 0.02 ? kMarchSteps : 0;
    // Two loops in sequence, with all else after them: software renderers run nested loops for every step.
    int k = 1;
    float here = 0.0;
    bool isHit = false;
    for (; k <= count && !isHit; ++k) {
        float share = float(k) / float(kMarchSteps);
        before = here;
        here = share * sqrt(share);  // shorter near the water, where the shore is
        isHit = isHitBetween(start + before * way, start + here * way);
    }
    int refined = isHit ? kRefineSteps : 0;
    for (int r = 0; r < refined; ++r) {
        float middle = 0.5 * (before + here);
        bool isIn = isBehind(start + middle * way);
        here = isIn ? middle : here;
        before = isIn ? before : middle;
    }
    // A long step may have passed above what it seems to end in.
    isHit = isHit && isHitBetween(start + before * way, start + here * way);
    vec4 result = isHit ? seenAt(start + here * way, way.xy) : vec4(0.0);
    result.a *= smoothstep(kLeastMirror, 2.0 * kLeastMirror, mirror);
    return result;
}
