// The colour of the sky in a direction (unit length), without the disc of the sun or moon. Also what distance fades to.
vec3 skyColor(vec3 direction) {
    float height = max(direction.z, 0.0);
    vec3 color = mix(frame.zenithColor.rgb, frame.horizonColor.rgb, exp(-5.0 * height));
    float toLight = max(dot(direction, frame.lightDirection.xyz), 0.0);
    float nearHorizon = exp(-3.0 * abs(direction.z));
    float halo = 0.25 * pow(toLight, 4.0) * nearHorizon + 0.4 * pow(toLight, 24.0) + 0.5 * pow(toLight, 180.0);
    return color + frame.glowColor.rgb * halo;
}
