// The visible sky, also behind surfaces that fade. CLOUDS: 1 draws clouds. NIGHT: 1 draws stars and the face of the
// moon. DIRECT: 1 writes display colors (target.h).
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/sky/sky_color.glsl"
#include "terrane/render/sky/clouds.glsl"
#include "terrane/render/frame/tone.glsl"
#if NIGHT == 1
#include "terrane/render/sky/stars.glsl"
#endif

layout(location = 1) in vec3 inRay;
layout(location = 0) out vec4 outColor;

#if NIGHT == 1
// Bright and dark plains of the moon.
float moonFace(vec2 at, float rim) {
    float pattern = texture(cloudNoise, 0.12 * at + 0.3).r + 0.5 * texture(cloudNoise, 0.3 * at).g;
    return (0.35 + 0.65 * smoothstep(0.5, 1.0, pattern)) * (0.6 + 0.4 * rim);
}
#endif

// Point where a direction in front of the camera meets the image plane, one block ahead.
vec2 onImagePlane(vec3 direction) {
    vec3 at = direction / max(dot(direction, frame.rayAhead.xyz), 0.01) - frame.rayAhead.xyz;
    return vec2(dot(at, normalize(frame.rayAcross.xyz)), dot(at, normalize(frame.rayUp.xyz)));
}

// The disc is round everywhere in the image: a perspective view would stretch it toward the edges. The sun is darker
// and redder toward its rim (D. Hestroffer, C. Magnan, Wavelength dependency of the solar limb darkening, 1998); its
// edge is soft, and the horizon cuts it off.
vec4 disc(vec3 direction) {
    vec3 light = frame.lightDirection.xyz;
    vec2 at = (onImagePlane(direction) - onImagePlane(light)) / frame.discSine;  // from the middle, 1 at the rim
    float away = length(at), pixel = length(fwidth(at)), rim = sqrt(max(1.0 - away * away, 0.0));
    float isFacing = step(0.0, dot(light, frame.rayAhead.xyz));
    float share = isFacing * (1.0 - smoothstep(1.0 - max(pixel, 0.06), 1.0, away));
    vec3 sun = mix(vec3(0.45, 0.34, 0.22), vec3(1.0), rim);
    vec3 face = sun;
#if NIGHT == 1
    face = frame.isMoon != 0u ? vec3(moonFace(at, rim)) : sun;
#endif
    return vec4(frame.discColor.rgb * face, share * smoothstep(-0.004, 0.004, direction.z));
}

void main() {
    vec3 direction = normalize(inRay);
    vec4 sun = disc(direction);
    vec3 sky = skyColor(direction), color = sky;
#if CLOUDS == 1
    vec4 cloud = clouds(direction, sky);
#else
    vec4 cloud = vec4(0.0);
#endif
#if NIGHT == 1
    float clear = 1.0 - cloud.a;
    color += nightSky(direction, length(fwidth(direction))) * ((1.0 - sun.a) * clear * clear * clear);
#endif
    color = mix(color, max(color, sun.rgb), sun.a);
    color = mix(color, cloud.rgb, cloud.a * kCloudShown);
    if (frame.waterAbove != 0u) color = throughWindow(color, direction);
#if DIRECT == 1
    outColor = vec4(screenColor(color, ivec2(gl_FragCoord.xy)), 1.0);
#else
    outColor = vec4(color, 0.0);
#endif
}
