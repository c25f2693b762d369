// Light without leaks at corners, and with rounder, softer pools of light than the steps of the solver give: the nodes next
// to the sample say how open it is there, nodes up to four blocks away how bright.

const float kColorExponent = 2.1;  // beside that of the shading
const float kColorGain = 1.5;      // so that it is as bright in the middle of its reach

// The layer of nodes in front of the surface: two steps, the lowest node, and the entries of the four light tiles by u, then v.
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

// Opaque blocks are those without any light. Air in the dark has none to give either.
float visibility(vec4 light) {
    return light == vec4(0.0) ? 0.0 : 1.0;
}

// 1 where one may see the other: in the air light loses a level a step. Falls to 0 over one level, so that nothing appears at
// once where the sample moves.
float link(vec4 a, vec4 b, float steps) {
    vec4 d = abs(a - b);
    return clamp(steps + 1.5 - 15.0 * max(max(d.r, d.g), max(d.b, d.a)), 0.0, 1.0);
}

// The last levels of a lamp fade into the dark: a straight line would end in an edge, and in the one color that
// reaches farthest.
vec4 toned(vec4 light) {
    return vec4(kColorGain * pow(light.rgb, vec3(kColorExponent)), light.a);
}

// The four nodes around the sample. A node across the corner counts only if light gets round it: not between two opaque
// blocks.
struct Close {
    vec4 light;  // of those that are open
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

// The mean of four points two blocks aside, diagonally, each from the nodes with even coordinates around it: where levels
// fall by |x| + |y| that is max(|x|, 2) + max(|y|, 2) at these nodes, without a crease and with blunt corners. Nodes that
// cannot be seen from here do not count, `close` stands for them.
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

// `at`: in nodes.
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
    bool isInWorld = blockAt(layer, ivec2(kSpan)).z < 256;  // above it is the sky
    if (isUniform && isInWorld) return toned(unpackLight(layer.entries.x & 0xFFFFu));
    vec3 rest = at - vec3(layer.lowest);
    vec2 inLayer = vec2(dot(rest, vec3(layer.stepU)), dot(rest, vec3(layer.stepV)));
    Close close = closeNodes(layer, inLayer);
#if LIGHT_SMOOTH == 2
    return close.visibility * toned(close.light);
#else
    return close.visibility * toned(farNodes(layer, inLayer, close));
#endif
}
