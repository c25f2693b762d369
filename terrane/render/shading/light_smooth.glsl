// Light without leaks at corners, with rounder and softer pools of light than the levels of the solver have: the nodes
// next to the sample give its visibility, nodes up to four blocks away its brightness.

const float kColorExponent = 2.1;  // in addition to that of the shading
const float kColorGain = 1.5;      // keeps the brightness in the middle of the reach

// Layer of nodes in front of the surface: two steps, the lowest node, and the entries of the four light tiles by u,
// then v.
struct NodeLayer {
    ivec3 lowest, stepU, stepV;
    uvec4 entries;
};

const int kSpan = 6;  // from the lowest node to the highest; two light tiles at most

ivec3 blockAt(NodeLayer layer, ivec2 node) {
    return layer.lowest + node.x * layer.stepU + node.y * layer.stepV;
}

vec4 lightAt(NodeLayer layer, ivec2 node) {
    ivec3 block = blockAt(layer, node), beyond = (block >> 3) - (layer.lowest >> 3);
    uvec2 row = beyond * layer.stepV == ivec3(0) ? layer.entries.xy : layer.entries.zw;
    return lightOfEntry(beyond * layer.stepU == ivec3(0) ? row.x : row.y, block);
}

// A node without any light counts as opaque. Dark air adds no light either.
float visibility(vec4 light) {
    return light == vec4(0.0) ? 0.0 : 1.0;
}

// 1 if light may pass between two nodes: in air it loses a level a step. Falls to 0 over one level, so that nothing
// jumps when the sample moves.
float link(vec4 a, vec4 b, float steps) {
    vec4 d = abs(a - b);
    return clamp(steps + 1.5 - 15.0 * max(max(d.r, d.g), max(d.b, d.a)), 0.0, 1.0);
}

// Fades the last levels of a lamp into the dark: a linear fade would end in a visible edge, in the one color that
// reaches farthest.
vec4 toned(vec4 light) {
    return vec4(kColorGain * pow(light.rgb, vec3(kColorExponent)), light.a);
}

// The four nodes around the sample. The diagonal node counts only if light gets around the corner to it: not between
// two opaque blocks.
struct Close {
    vec4 light;  // of the open ones
    float visibility;  // their share, by weight
};

Close closeNodes(NodeLayer layer, vec2 at) {
    ivec2 middle = ivec2(floor(at + 0.5)), aside = ivec2(sign(at - vec2(middle)));
    vec2 f = abs(at - vec2(middle));
    vec4 besideU = lightAt(layer, middle + ivec2(aside.x, 0)), besideV = lightAt(layer, middle + ivec2(0, aside.y));
    vec4 across = lightAt(layer, middle + aside);
    vec4 nearest = lightAt(layer, middle);
    Close c;
    vec4 weights = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    vec2 open = vec2(visibility(besideU), visibility(besideV));
    weights *= vec4(visibility(nearest), open, max(open.x, open.y) * visibility(across));
    c.visibility = dot(weights, vec4(1.0));
    c.light = (weights.x * nearest + weights.y * besideU + weights.z * besideV + weights.w * across) / max(c.visibility, 1e-4);
    return c;
}

// The mean of four points two blocks away diagonally, each interpolated from the nodes with even coordinates around it:
// where levels fall by |x| + |y| that is max(|x|, 2) + max(|y|, 2) at these nodes, without a crease and with blunt
// corners. Hidden nodes are replaced by `close`.
vec4 farNodes(NodeLayer layer, vec2 at, Close close) {
    vec2 t = 0.5 * at - 1.0;
    vec4 weightsU = 0.5 * vec4(1.0 - t.x, t.x, 1.0 - t.x, t.x), weightsV = 0.5 * vec4(1.0 - t.y, t.y, 1.0 - t.y, t.y);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int k = 0; k < 16; ++k) {
        ivec2 node = ivec2(k & 3, k >> 2);
        vec4 light = lightAt(layer, 2 * node);
        vec2 away = abs(at - vec2(2 * node));
        float weight = weightsU[node.x] * weightsV[node.y] * visibility(light) * link(light, close.light, away.x + away.y);
        sum += weight * light;
        weights += weight;
    }
    return sum + (1.0 - weights) * close.light;
}

// `at`: position in nodes.
vec4 sampleSmooth(vec3 at, vec3 normal) {
    vec3 size = abs(normal);
    NodeLayer layer;
    layer.stepU = size.x > 0.5 ? ivec3(0, 1, 0) : ivec3(1, 0, 0);
    layer.stepV = max(size.x, size.y) > 0.5 ? ivec3(0, 0, 1) : ivec3(0, 1, 0);
    ivec3 aside = layer.stepU + layer.stepV;
    layer.lowest = ivec3(floor(at + 0.5)) * (1 - aside) + (2 * ivec3(floor(0.5 * at)) - 2) * aside;
    layer.entries = uvec4(lightEntry(blockAt(layer, ivec2(0))), lightEntry(blockAt(layer, ivec2(kSpan, 0))),
                          lightEntry(blockAt(layer, ivec2(0, kSpan))), lightEntry(blockAt(layer, ivec2(kSpan))));
    bool isUniform = (layer.entries.x & kLightUniformBit) != 0u && layer.entries == layer.entries.xxxx;
    bool isInWorld = blockAt(layer, ivec2(kSpan)).z < frame.top;  // above it is the sky
    if (isUniform && isInWorld) return toned(unpackLight(layer.entries.x & 0xFFFFu));
    vec3 rest = at - vec3(layer.lowest);
    vec2 inLayer = vec2(dot(rest, vec3(layer.stepU)), dot(rest, vec3(layer.stepV)));
    Close close = closeNodes(layer, inLayer);
#if LIGHT == LIGHT_SIMPLE
    return close.visibility * toned(close.light);
#else
    return close.visibility * toned(farNodes(layer, inLayer, close));
#endif
}
