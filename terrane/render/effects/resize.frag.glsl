// Resizes an image of display colors, or sharpens it afterwards. RESIZING: see shared/variants.h. The edges and the
// sharpening follow FidelityFX Super Resolution 1 (T. Lottes, AMD, 2021): a Lanczos kernel of two lobes, stretched along
// the edge at the pixel, and a negative lobe as strong as it can be without leaving the range of the neighbors.
#include "terrane/render/frame/frame_uniforms.glsl"

layout(binding = kSceneUnit) uniform sampler2D image;
layout(location = 0) in vec2 inScreen;  // -1…1
layout(location = 0) out vec4 outColor;

#if RESIZING == RESIZE_EDGES
float brightness(vec3 color) {
    return 0.5 * color.r + color.g + 0.5 * color.b;
}

vec3 texelAt(ivec2 texel) {
    return texelFetch(image, clamp(texel, ivec2(0), textureSize(image, 0) - 1), 0).rgb;
}

// Adds the slope at a texel, and how much of it is an edge rather than noise: `before` and `after` are its neighbors.
void addSlope(inout float direction, inout float edge, float weight, float before, float here, float after) {
    float across = after - before, steepest = max(abs(after - here), abs(here - before));
    float share = clamp(abs(across) / max(steepest, 1.0 / 32768.0), 0.0, 1.0);
    direction += weight * across;
    edge += weight * share * share;
}

vec3 resized() {
    vec2 at = (0.5 + 0.5 * inScreen) * vec2(textureSize(image, 0)) - 0.5, corner = floor(at), f = at - corner;
    vec3 colors[16];
    float light[16];
    for (int k = 0; k < 16; ++k) {
        colors[k] = texelAt(ivec2(corner) + ivec2(k & 3, k >> 2) - 1);
        light[k] = brightness(colors[k]);
    }
    vec2 direction = vec2(0.0);
    float edge = 0.0;
    for (int k = 0; k < 4; ++k) {
        ivec2 texel = ivec2(k & 1, k >> 1);
        int n = 5 + texel.x + 4 * texel.y;
        vec2 w = mix(1.0 - f, f, vec2(texel));
        addSlope(direction.x, edge, w.x * w.y, light[n - 1], light[n], light[n + 1]);
        addSlope(direction.y, edge, w.x * w.y, light[n - 4], light[n], light[n + 4]);
    }
    float size = length(direction);
    direction = size < 1.0 / 256.0 ? vec2(1.0, 0.0) : direction / size;
    edge = 0.25 * edge * edge;
    // Along the edge the kernel is longer, most of all along diagonals, and its lobes are weaker.
    float stretch = 1.0 / max(abs(direction.x), abs(direction.y));
    vec2 scale = vec2(1.0 + (stretch - 1.0) * edge, 1.0 - 0.5 * edge);
    float lobe = 0.5 - 0.29 * edge, end = 1.0 / lobe;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int k = 0; k < 16; ++k) {
        ivec2 texel = ivec2(k & 3, k >> 2) - 1;
        if (texel.x * (texel.x - 1) != 0 && texel.y * (texel.y - 1) != 0) continue;  // corners
        vec2 away = vec2(texel) - f;
        vec2 turned = vec2(dot(away, direction), dot(away, vec2(-direction.y, direction.x))) * scale;
        float d2 = min(dot(turned, turned), end);
        float base = 0.4 * d2 - 1.0, window = lobe * d2 - 1.0;
        float weight = (1.5625 * base * base - 0.5625) * window * window;
        sum += weight * colors[k];
        weights += weight;
    }
    vec3 low = min(min(colors[5], colors[6]), min(colors[9], colors[10]));
    vec3 high = max(max(colors[5], colors[6]), max(colors[9], colors[10]));
    return clamp(sum / weights, low, high);
}
#elif RESIZING == RESIZE_SHARPEN
vec3 resized() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(image, 0) - 1;
    vec3 middle = texelFetch(image, pixel, 0).rgb;
    vec3 left = texelFetch(image, max(pixel - ivec2(1, 0), ivec2(0)), 0).rgb;
    vec3 right = texelFetch(image, min(pixel + ivec2(1, 0), last), 0).rgb;
    vec3 below = texelFetch(image, max(pixel - ivec2(0, 1), ivec2(0)), 0).rgb;
    vec3 above = texelFetch(image, min(pixel + ivec2(0, 1), last), 0).rgb;
    vec3 low = min(min(left, right), min(below, above)), high = max(max(left, right), max(below, above));
    // The strongest lobe that keeps the result between 0 and 1.
    vec3 toBlack = min(low, middle) / max(4.0 * high, 1e-4), toWhite = (1.0 - max(high, middle)) / min(4.0 * low - 4.0, -1e-4);
    vec3 lobes = max(-toBlack, toWhite);
    const float kLimit = 0.1875, kSharpness = 0.4;
    float lobe = max(-kLimit, min(max(max(lobes.r, lobes.g), lobes.b), 0.0)) * kSharpness;
    return (lobe * (left + right + below + above) + middle) / (4.0 * lobe + 1.0);
}
#elif RESIZING == RESIZE_NEAREST
vec3 resized() {
    return texelFetch(image, ivec2((0.5 + 0.5 * inScreen) * vec2(textureSize(image, 0))), 0).rgb;
}
#else
// The mean of the square that the pixel covers: each fetch blends four texels.
vec3 resized() {
    vec2 perPixel = fwidth(0.5 * inScreen);
    ivec2 steps = max(ivec2(ceil(0.5 * perPixel * vec2(textureSize(image, 0)) - 1e-3)), 1);
    vec3 sum = vec3(0.0);
    for (int y = 0; y < steps.y; ++y) {
        for (int x = 0; x < steps.x; ++x) {
            vec2 inPixel = (vec2(x, y) + 0.5) / vec2(steps) - 0.5;
            sum += textureLod(image, 0.5 + 0.5 * inScreen + inPixel * perPixel, 0.0).rgb;
        }
    }
    return sum / float(steps.x * steps.y);
}
#endif

void main() {
    outColor = vec4(resized(), 1.0);
}
