// Noise and random numbers for one sample, with the operations of gen/noise/noise.h in the same order as the CPU's tiles.
#include "terrane/shared/det_math.h"
#include "terrane/shared/hash.h"

// floor(a / b) for b > 0; GLSL leaves the rounding of negative quotients open.
int floorDivide(int a, int b) {
    return a >= 0 ? a / b : ~(~a / b);
}

int floorDivideOr0(int a, int b) {
    return b < 1 ? 0 : floorDivide(a, b);
}

// Every NaN has the same bits.
int floatBits(float v) {
    int bits = floatBitsToInt(v);
    return (bits & 0x7FFFFFFF) > 0x7F800000 ? 0x7FC00000 : bits;
}

// -2^31 for what does not fit and for NaN.
int truncateToInt(float v) {
    return abs(v) < 2147483648.0 ? int(v) : int(0x80000000u);
}

float fadeCurve(float f) {
    precise float t = ((f * f) * f) * (f * (f * 6.0 - 15.0) + 10.0);
    return t;
}

float blend(float a, float b, float t) {
    precise float v = a + t * (b - a);
    return v;
}

// kQuadrant of gen/noise/noise.h as bits: compilers round decimal constants differently.
const float kQuadrant[4] = float[4](uintBitsToFloat(0x3FB18A86u), uintBitsToFloat(0x3F968317u),
                                    uintBitsToFloat(0x3F49234Eu), uintBitsToFloat(0x3E8D42AFu));

vec2 gradient2(int x, int y, uint seed) {
    uint k = hash2(uint(x), uint(y), seed) >> 28;
    uint step = k & 3u;
    // Each quadrant is the one before turned by a right angle.
    vec2 first = vec2(kQuadrant[step], kQuadrant[3u - step]);
    uint quadrant = k >> 2;
    if (quadrant == 0u) return first;
    if (quadrant == 1u) return vec2(-first.y, first.x);
    if (quadrant == 2u) return -first;
    return vec2(first.y, -first.x);
}

// The 12 vectors to the edges of a cube.
vec3 gradient3(int x, int y, int z, uint seed) {
    uint k = ((hash3(uint(x), uint(y), uint(z), seed) >> 16) * 12u) >> 16;
    float s = (k & 1u) == 0u ? 1.0 : -1.0;
    float t = (k & 2u) == 0u ? 1.0 : -1.0;
    if (k < 4u) return vec3(s, t, 0.0);
    if (k < 8u) return vec3(s, 0.0, t);
    return vec3(0.0, s, t);
}

struct AxisCell {
    int cell;
    float offset, fade;
};

AxisCell axisCell(int at, int size, float inverseSize) {
    AxisCell a;
    a.cell = floorDivide(at, size);
    precise float offset = float(at - a.cell * size) * inverseSize;
    a.offset = offset;
    a.fade = fadeCurve(offset);
    return a;
}

// Blends two node rows at the offset f from the lower one.
float betweenRows(vec2 low, vec2 high, float f, float t) {
    precise float lower = low.x + low.y * f;
    precise float upper = high.x + high.y * (f - 1.0);
    return blend(lower, upper, t);
}

vec2 nodeRow2(AxisCell x, int y, uint seed) {
    vec2 left = gradient2(x.cell, y, seed), right = gradient2(x.cell + 1, y, seed);
    precise float l = left.x * x.offset, r = right.x * (x.offset - 1.0);
    return vec2(blend(l, r, x.fade), blend(left.y, right.y, x.fade));
}

float perlin2D(int px, int py, int size, float inverseSize, uint seed) {
    AxisCell x = axisCell(px, size, inverseSize), y = axisCell(py, size, inverseSize);
    return betweenRows(nodeRow2(x, y.cell, seed), nodeRow2(x, y.cell + 1, seed), y.offset, y.fade);
}

// Coefficients of 1, of the y offset and of the z offset.
vec3 nodeRow3(AxisCell x, int y, int z, uint seed) {
    vec3 left = gradient3(x.cell, y, z, seed), right = gradient3(x.cell + 1, y, z, seed);
    precise float l = left.x * x.offset, r = right.x * (x.offset - 1.0);
    return vec3(blend(l, r, x.fade), blend(left.y, right.y, x.fade), blend(left.z, right.z, x.fade));
}

vec2 layerRow(AxisCell x, int y, AxisCell z, uint seed) {
    vec3 low = nodeRow3(x, y, z.cell, seed), high = nodeRow3(x, y, z.cell + 1, seed);
    precise float l = low.x + low.z * z.offset, h = high.x + high.z * (z.offset - 1.0);
    return vec2(blend(l, h, z.fade), blend(low.y, high.y, z.fade));
}

float perlin3D(int px, int py, int pz, int size, float inverseSize, uint seed) {
    AxisCell x = axisCell(px, size, inverseSize), y = axisCell(py, size, inverseSize), z = axisCell(pz, size, inverseSize);
    return betweenRows(layerRow(x, y.cell, z, seed), layerRow(x, y.cell + 1, z, seed), y.offset, y.fade);
}
