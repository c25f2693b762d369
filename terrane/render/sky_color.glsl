// The color of the sky in a direction (unit length), without the disc of the sun or moon, clouds and stars. Also what
// distance fades to and what water mirrors.
vec3 skyColor(vec3 direction) {
    float height = max(direction.z, 0.0);
    // Darker toward the zenith, where one looks through less air, and pale near the horizon.
    float nearHorizon = exp(-2.75 * height);
    vec3 color = mix(frame.zenithColor.rgb, frame.horizonColor.rgb, nearHorizon * nearHorizon);
    float toLight = max(dot(direction, frame.lightDirection.xyz), 0.0);
    float t2 = toLight * toLight, t4 = t2 * t2, t8 = t4 * t4;
    float near = exp(-90.0 * (1.0 - toLight)), near3 = near * near * near;
    float halo = 0.25 * t4 * nearHorizon + 0.28 * t8 * t8 + 0.35 * near;
    return color + frame.glowColor.rgb * halo + frame.lightColor.rgb * 0.35 * near3 * near3;
}

// What one sees in water where there is nothing: bluer and darker the more of it is above.
vec3 murk() {
    vec3 fromAbove = exp(-vec3(0.10, 0.055, 0.035) * float(max(int(frame.isUnderWater) - 1, 0)));
    return vec3(0.02, 0.13, 0.19) * fromAbove * (frame.ambientColor.rgb + 0.6 * frame.lightColor.rgb) + 0.002;
}
