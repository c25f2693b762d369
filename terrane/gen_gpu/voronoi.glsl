// Cells of random points for one sample, with the operations of gen/noise/noise.h in the same order as the CPU's tiles.
#include "terrane/gen_gpu/noise.glsl"

struct Voronoi {
    float distance, ratio;
    ivec2 offset;
};

Voronoi voronoi2D(int px, int py, int size, uint maxPoints, uint seed) {
    int cellX = floorDivide(px, size), cellY = floorDivide(py, size);
    int best = 0x7FFFFFFF, second = 0x7FFFFFFF;
    ivec2 offset = ivec2(0);
    for (int cy = cellY - 2; cy <= cellY + 2; ++cy) {
        for (int cx = cellX - 2; cx <= cellX + 2; ++cx) {
            uint h = hash2(uint(cx), uint(cy), seed);
            uint count = 1u + (((h >> 16) * maxPoints) >> 16);
            for (uint k = 0u; k < count; ++k) {
                uint hx = mixBits(h + (2u * k + 1u) * kHashX), hy = mixBits(h + (2u * k + 2u) * kHashY);
                int dx = cx * size - px + int((hx >> 16) * uint(size) >> 16);
                int dy = cy * size - py + int((hy >> 16) * uint(size) >> 16);
                // Farther ones are never among the two nearest; their squares might not fit.
                if (abs(dx) >= 2 * size || abs(dy) >= 2 * size) continue;
                int d = dx * dx + dy * dy;
                bool nearer = d < best;
                second = nearer ? best : min(second, d);
                offset = nearer ? ivec2(dx, dy) : offset;
                best = nearer ? d : best;
            }
        }
    }
    Voronoi v;
    v.distance = detSqrt(float(best));
    v.ratio = detDivide(v.distance, detSqrt(float(max(second, 1))));
    v.offset = offset;
    return v;
}

struct Voronoi3 {
    float nearest, second;  // sums of powers
    ivec3 offset;
};

float powerOf(int blocks, float inverseSize, int exponent) {
    precise float d = float(abs(blocks)) * inverseSize;
    precise float result = d;
    for (int k = 1; k < exponent; ++k) result = result * d;
    return result;
}

Voronoi3 voronoi3D(ivec3 p, int size, float inverseSize, uint maxPoints, int exponent, uint seed) {
    ivec3 own = ivec3(floorDivide(p.x, size), floorDivide(p.y, size), floorDivide(p.z, size));
    Voronoi3 v = Voronoi3(3.402823466e38, 3.402823466e38, ivec3(0));
    for (int cell = 0; cell < 125; ++cell) {
        ivec3 c = own + ivec3(cell % 5, cell / 5 % 5, cell / 25) - 2;
        uint h = hash3(uint(c.x), uint(c.y), uint(c.z), seed);
        uint count = 1u + (((h >> 16) * maxPoints) >> 16);
        for (uint k = 0u; k < count; ++k) {
            uvec3 hashes = uvec3(mixBits(h + (3u * k + 1u) * kHashX), mixBits(h + (3u * k + 2u) * kHashY),
                                 mixBits(h + (3u * k + 3u) * kHashZ));
            ivec3 d = c * size - p + ivec3((hashes >> 16) * uint(size) >> 16);
            precise float sum = (powerOf(d.x, inverseSize, exponent) + powerOf(d.y, inverseSize, exponent)) +
                                powerOf(d.z, inverseSize, exponent);
            bool nearer = sum < v.nearest;
            v.second = nearer ? v.nearest : (sum < v.second ? sum : v.second);
            v.offset = nearer ? d : v.offset;
            v.nearest = nearer ? sum : v.nearest;
        }
    }
    return v;
}
