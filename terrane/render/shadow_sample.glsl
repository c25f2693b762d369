// The share of the sun's or moon's light that no block near the camera stops. Needs frame_uniforms.glsl.
layout(binding = kShadowUnit) uniform sampler2DShadow shadowMap;

// The mean of the four nearest texels' answers (percentage-closer filtering by the sampler). The point is moved off its
// surface by a texel and a half along the normal, so that the surface does not shade itself, and fades out before the map
// ends.
float lightShare(vec3 position, vec3 normal, float distance) {
    float slope = 1.0 - max(dot(normal, frame.lightDirection.xyz), 0.0);
    vec3 at = position + normal * (0.02 + 1.5 * frame.shadowTexelBlocks * slope);
    vec3 onMap = (frame.toShadowMap * vec4(at, 1.0)).xyz;
    float lit = texture(shadowMap, onMap);
    float fade = frame.shadowStrength * (1.0 - smoothstep(0.8, 1.0, distance / frame.shadowReach));
#if LAND == 1
    return mix(landShare(position), lit, fade);
#else
    return mix(1.0, lit, fade);
#endif
}
