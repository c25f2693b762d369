// The sky where it can be seen, behind surfaces that fade too. CLOUDS: 1 draws clouds. DIRECT: 1 writes what the screen shows.
#include "terrane/render/frame_uniforms.glsl"
#include "terrane/render/sky_color.glsl"
#include "terrane/render/clouds.glsl"
#include "terrane/render/tone.glsl"

layout(location = 1) in vec3 inRay;
layout(location = 0) out vec4 outColor;

// The sun is plain; the moon has plains, brighter and darker.
vec3 discColor(vec2 at) {
    float isMoon = float(frame.isMoon);
    float pattern = texture(cloudNoise, 0.12 * at + 0.3).r + 0.5 * texture(cloudNoise, 0.3 * at).g;
    float rim = sqrt(max(1.0 - dot(at, at), 0.0));
    return frame.discColor.rgb * mix(1.0, (0.35 + 0.65 * smoothstep(0.5, 1.0, pattern)) * (0.6 + 0.4 * rim), isMoon);
}

vec4 disc(vec3 direction) {
    vec3 light = frame.lightDirection.xyz;
    vec3 across = normalize(cross(light, vec3(0.0, 0.0, 1.0))), up = cross(across, light);
    vec2 at = vec2(dot(direction, across), dot(direction, up)) / frame.discSine;  // from the middle, 1 at the rim
    float pixel = length(fwidth(at));
    float share = dot(direction, light) > 0.0 ? 1.0 - smoothstep(1.0 - pixel, 1.0, length(at)) : 0.0;
    return vec4(discColor(at), share);
}

void main() {
    vec3 direction = normalize(inRay);
    vec4 sun = disc(direction);
    vec3 color = skyColor(direction);
    float pixel = length(fwidth(direction)), night = frame.starBrightness;
    if (night > 0.0)
        color += stars(starDirection(direction), pixel) * night * (1.0 - sun.a) * smoothstep(0.0, 0.2, direction.z);
    color = mix(color, max(color, sun.rgb), sun.a);
#if CLOUDS == 1
    vec4 cloud = clouds(direction);
    color = mix(color, cloud.rgb, cloud.a * 0.92);
#endif
    // From within water the sky is seen through a round window above, beyond which the surface mirrors what is below.
    if (frame.isUnderWater != 0u) color = mix(murk(), color, 0.8 * smoothstep(0.5, 0.8, direction.z));
#if DIRECT == 1
    outColor = vec4(screenColor(color, ivec2(gl_FragCoord.xy)), 1.0);
#else
    outColor = vec4(color, 0.0);
#endif
}
