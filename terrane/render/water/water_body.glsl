// The color of water, and how much it mirrors.

// Share of light that passes through so many blocks: red is absorbed first. Murkier than clear water.
vec3 throughBody(float blocks) {
    return exp(-vec3(0.34, 0.19, 0.165) * blocks);
}

// Light scattered back by so much water of a color: turquoise if shallow, dark if deep.
vec3 waterBody(vec3 color, vec3 lit, float blocks) {
    vec3 shallow = color * vec3(0.75, 1.15, 1.0) + vec3(0.0, 0.06, 0.045), deep = color * vec3(0.07, 0.24, 0.38);
    return mix(deep, shallow, exp(-0.13 * blocks)) * lit;
}

// Schlick's approximation with the reflectance of water seen from above, 0.02.
float waterMirror(float facing) {
    return 0.02 + 0.98 * pow(1.0 - clamp(facing, 0.0, 1.0), 5.0);
}
