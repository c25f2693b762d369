// Paints figures into the G-buffer, or with PASS_CORNERS into the image, in squares of 1/20 block: plain colors with a
// little grain, and a face.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/figures/figure_look.glsl"
#include "terrane/render/quads/packed_gbuffer.glsl"

layout(location = 0) in vec3 inPlace;
layout(location = 1) flat in uvec2 inFace;
#if PASS == PASS_CORNERS
layout(location = 2) in vec3 inScale;  // see corner_shade.glsl
layout(location = 3) in vec3 inAdded;
#else
layout(location = 2) flat in vec3 inNormal;
#endif
layout(location = 0) out vec4 outSurface;

const float kTexel = 0.05;  // blocks
const float kChin = 1.37;   // height

const uint kAhead = 1u, kBack = 0u, kBelow = 4u, kAbove = 5u;  // sides of a box

// sRGB, as are all colors here. Consecutive shirts differ most.
const uint kShirts = 12u;
const vec3 kShirtColors[kShirts] = vec3[](
    vec3(0.78, 0.24, 0.22), vec3(0.20, 0.47, 0.74), vec3(0.93, 0.74, 0.25), vec3(0.29, 0.58, 0.32), vec3(0.56, 0.34, 0.66),
    vec3(0.90, 0.52, 0.20), vec3(0.25, 0.64, 0.64), vec3(0.88, 0.50, 0.62), vec3(0.88, 0.86, 0.80), vec3(0.34, 0.36, 0.52),
    vec3(0.62, 0.72, 0.26), vec3(0.55, 0.38, 0.27));
const uint kTrousers = 5u;
const vec3 kTrouserColors[kTrousers] = vec3[](vec3(0.25, 0.31, 0.44), vec3(0.36, 0.29, 0.24), vec3(0.31, 0.34, 0.33),
                                              vec3(0.55, 0.48, 0.36), vec3(0.29, 0.37, 0.28));
const uint kHairs = 6u;
const vec3 kHairColors[kHairs] = vec3[](vec3(0.20, 0.15, 0.13), vec3(0.38, 0.24, 0.15), vec3(0.60, 0.40, 0.20),
                                        vec3(0.85, 0.68, 0.36), vec3(0.66, 0.30, 0.16), vec3(0.60, 0.60, 0.60));
const uint kSkins = 5u;
const vec3 kSkinColors[kSkins] = vec3[](vec3(0.96, 0.80, 0.68), vec3(0.90, 0.71, 0.56), vec3(0.78, 0.58, 0.43),
                                        vec3(0.60, 0.42, 0.30), vec3(0.44, 0.30, 0.22));
const uint kEyes = 4u;
const vec3 kEyeColors[kEyes] = vec3[](vec3(0.22, 0.38, 0.60), vec3(0.30, 0.20, 0.13), vec3(0.24, 0.44, 0.28),
                                      vec3(0.26, 0.26, 0.30));

vec3 shirtOf(uint look) {
    return kShirtColors[look % kShirts];
}
// Never the color of the shirt.
vec3 scarfOf(uint look) {
    return kShirtColors[(look + 2u + choiceOf(look, 2u, kShirts - 4u)) % kShirts];
}
vec3 skinOf(uint look) {
    return kSkinColors[choiceOf(look, 3u, kSkins)];
}
vec3 hairOf(uint look) {
    return kHairColors[choiceOf(look, 4u, kHairs)];
}
vec3 trousersOf(uint look) {
    return kTrouserColors[choiceOf(look, 5u, kTrousers)];
}

// Texel of the head: 0 … 7 upward from the chin, -4 … 3 from the right.
ivec2 squareOfHead(float across, float height) {
    return ivec2(floor(vec2(across, height - kChin) / kTexel));
}

vec3 faceColor(uint look, float across, float height) {
    vec3 skin = skinOf(look);
    ivec2 at = squareOfHead(across, height);
    int aside = at.x < 0 ? -1 - at.x : at.x;  // 0 … 3 from the middle
    bool isEye = at.y == 3 || at.y == 4;
    if (isEye && aside == 1) return at.y == 4 ? vec3(0.10, 0.08, 0.09) : kEyeColors[choiceOf(look, 6u, kEyes)];
    if (isEye && aside == 2) return vec3(0.96, 0.96, 0.94);
    const vec3 kMouth = vec3(0.55, 0.18, 0.17);
    if (at.y == 1 && aside == 0) return mix(skin, kMouth, 0.65);
    if (at.y == 1 && aside == 1) return mix(skin, kMouth, height < kChin + 1.5 * kTexel ? 0.0 : 0.45);
    if (at.y == 2 && aside >= 2) return mix(skin, vec3(0.90, 0.38, 0.34), 0.3);
    return aside == 3 && at.y >= 4 ? hairOf(look) : skin;
}

// Hair over the ears; longer toward the back.
vec3 sideOfHead(uint look, float along, float height) {
    ivec2 at = squareOfHead(along, height);
    int lowest = at.x >= 2 ? 4 : at.x >= 0 ? 3 : 1;
    return at.y >= lowest ? hairOf(look) : skinOf(look);
}

vec3 headColor(uint look, uint side, vec3 place) {
    if (side == kAhead) return faceColor(look, place.y, place.z);
    if (side == kBelow) return skinOf(look);
    return side == kBack || side == kAbove ? hairOf(look) : sideOfHead(look, place.x, place.z);
}

vec3 bodyColor(uint look, vec3 place) {
    const float kBelt = 0.75, kWaist = 0.70;
    if (place.z < kWaist) return trousersOf(look);
    if (place.z < kBelt) return abs(place.y) < 0.03 && place.x > 0.0 ? vec3(0.86, 0.72, 0.34) : vec3(0.27, 0.19, 0.14);
    uint pattern = choiceOf(look, 7u, 3u);
    bool isStripe = pattern == 1u && (int(floor(place.z / kTexel)) & 3) == 1;
    bool isVest = pattern == 2u && abs(place.y) > 0.05;
    return isStripe || isVest ? mix(shirtOf(look), scarfOf(look), 0.7) : shirtOf(look);
}

vec3 armColor(uint look, float height) {
    if (height < 0.8) return skinOf(look);
    return height < 0.85 ? 0.8 * shirtOf(look) : shirtOf(look);
}

vec3 hairOrCap(uint look) {
    return hairStyleOf(look) == kHairCap ? scarfOf(look) : hairOf(look);
}

vec3 colorOf(uint part, uint side, uint look, vec3 place) {
    if (part == kPartLeg) return trousersOf(look);
    if (part == kPartShoe) return place.z < 0.03 ? vec3(0.62, 0.58, 0.52) : vec3(0.30, 0.22, 0.18);
    if (part == kPartBody) return bodyColor(look, place);
    if (part == kPartArm) return armColor(look, place.z);
    if (part == kPartScarf) return scarfOf(look);
    if (part == kPartHead) return headColor(look, side, place);
    if (part == kPartNose) return 0.94 * skinOf(look);
    return part == kPartHair ? hairOrCap(look) : hairOf(look);
}

// Random brightness of a square; 0 if squares are smaller than pixels.
float grainAt(uint part, uint side, vec3 place) {
    uint axis = side >> 1;
    vec2 onFace = (axis == 0u ? place.yz : axis == 1u ? place.zx : place.xy) / kTexel;
    vec2 pixel = fwidth(onFace);
    uvec2 at = uvec2(ivec2(floor(onFace)) + 64);
    float grain = float(hash2(at.x, at.y, part << 3 | side) >> 24) / 255.0 - 0.5;
    return grain * clamp(2.0 - 2.0 * max(pixel.x, pixel.y), 0.0, 1.0);
}

void main() {
    uint part = inFace.x >> 3, side = inFace.x & 7u;
    vec3 color = colorOf(part, side, inFace.y, inPlace);
    float grain = part == kPartHead ? 0.03 : part == kPartHair || part == kPartHairUnderCap ? 0.16 : 0.08;
    color *= 1.0 + grain * grainAt(part, side, inPlace);
#if PASS == PASS_CORNERS
    outSurface = vec4(color * inScale + inAdded, 1.0);
#else
    outSurface = packFigure(color, inNormal);
#endif
}
