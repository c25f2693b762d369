// Stripes for one sample, with the operations of gen/noise/stripe_tile.h in the same order as the CPU's tiles.

// 1 / kStripeReach2 of gen/noise/stripe_tile.h as bits: compilers round constant divisions differently.
const float kInverseStripeReach2 = uintBitsToFloat(0x3F25294Bu);

// sin of so many turns.
float stripeWave(float turns) {
    precise float q = turns - floor(turns + 0.5);
    precise float wave = q * (8.0 - 16.0 * abs(q));
    return wave;
}

// cos and sin
vec2 stripes2D(int px, int py, float directionX, float directionY, int size, float inverseSize, uint seed) {
    int cellX = floorDivide(px, size), cellY = floorDivide(py, size);
    precise float weights = 0.0, cosine = 0.0, sine = 0.0;
    for (int y = cellY - 1; y <= cellY + 1; ++y) {
        for (int x = cellX - 1; x <= cellX + 1; ++x) {
            uint h = hash2(uint(x), uint(y), seed);
            precise float ox = float(x * size - px) * inverseSize + (0.25 + float(h & 1023u) * (0.5 / 1024.0));
            precise float oy = float(y * size - py) * inverseSize + (0.25 + float(h >> 10 & 1023u) * (0.5 / 1024.0));
            precise float t = max(1.0 - (ox * ox + oy * oy) * kInverseStripeReach2, 0.0);
            precise float weight = t * t;
            precise float turns = float(h >> 20) * (1.0 / 4096.0) - (ox * directionX + oy * directionY);
            if (weight <= 0.0) continue;
            weights = weights + weight;
            cosine = cosine + weight * stripeWave(turns + 0.25);
            sine = sine + weight * stripeWave(turns);
        }
    }
    return vec2(detDivide(cosine, weights), detDivide(sine, weights));
}
