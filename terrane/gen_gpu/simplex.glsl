// Simplex noise for one sample, with the operations of gen/noise/simplex_tile.h in the same order as the CPU's tiles.

const int kSimplexPeriod = 41, kSimplexShift = 15;
// 15/41, 15/71 and 70.3 as bits: compilers round constant divisions and decimals differently.
const float kSimplexSkew = uintBitsToFloat(0x3EBB512Cu), kSimplexUnskew = uintBitsToFloat(0x3E585689u),
            kSimplexScale = uintBitsToFloat(0x428C999Au);

float simplexCorner(int x, int y, uint seed, float offsetX, float offsetY) {
    vec2 g = gradient2(x, y, seed);
    precise float t = max(0.5 - (offsetX * offsetX + offsetY * offsetY), 0.0);
    precise float corner = ((t * t) * (t * t)) * (g.x * offsetX + g.y * offsetY);
    return corner;
}

float simplex2D(int px, int py, int size, float inverseSize, uint seed) {
    int periodX = floorDivide(px, kSimplexPeriod * size), periodY = floorDivide(py, kSimplexPeriod * size);
    precise float fx = float(px - periodX * (kSimplexPeriod * size)) * inverseSize;
    precise float fy = float(py - periodY * (kSimplexPeriod * size)) * inverseSize;
    precise float skew = (fx + fy) * kSimplexSkew;
    precise float i = floor(fx + skew), j = floor(fy + skew);
    precise float unskew = (i + j) * kSimplexUnskew;
    precise float x0 = fx - (i - unskew), y0 = fy - (j - unskew);
    int shift = (periodX + periodY) * kSimplexShift;
    int cellX = periodX * kSimplexPeriod + shift + int(i), cellY = periodY * kSimplexPeriod + shift + int(j);
    int right = x0 > y0 ? 1 : 0;
    precise float x1 = (x0 - float(right)) + kSimplexUnskew, y1 = (y0 - float(1 - right)) + kSimplexUnskew;
    precise float x2 = (x0 - 1.0) + 2.0 * kSimplexUnskew, y2 = (y0 - 1.0) + 2.0 * kSimplexUnskew;
    precise float sum = (simplexCorner(cellX, cellY, seed, x0, y0) +
                         simplexCorner(cellX + right, cellY + (1 - right), seed, x1, y1)) +
                        simplexCorner(cellX + 1, cellY + 1, seed, x2, y2);
    precise float scaled = kSimplexScale * sum;
    return scaled;
}
