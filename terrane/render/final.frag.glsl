// From light to the screen: blur of what is far, rays of the sun, exposure, a filmic curve, sRGB, and noise of one step
// against bands in the sky. DEPTH_OF_FIELD, GOD_RAYS: 1 adds them. RAW_OCCLUSION: 1 shows the ambient occlusion instead.
// MSAA_SAMPLES: of the depth.
#include "terrane/render/frame_uniforms.glsl"
#include "terrane/shared/hash.h"

layout(binding = kSceneUnit) uniform sampler2D scene;
#if DEPTH_OF_FIELD == 1
#include "terrane/render/gbuffer_read.glsl"
layout(binding = kDepthOfFieldUnit) uniform sampler2D blurred;
#endif
#if GOD_RAYS == 1
layout(binding = kGodRaysUnit) uniform sampler2D godRays;
#endif
#if RAW_OCCLUSION == 1
layout(binding = kOcclusionUnit) uniform sampler2D occlusion;
#endif

layout(location = 1) in vec3 inRay;
layout(location = 0) out vec4 outColor;

// Linear up to kStart, from there an exponential shoulder that meets it with equal slope and ends at white.
vec3 compressHighlights(vec3 c) {
    const float kStart = 0.6;
    vec3 over = max(c - kStart, 0.0);
    return min(c, kStart) + (1.0 - kStart) * (1.0 - exp(-over / (1.0 - kStart)));
}

// Linear to sRGB by roots, off by half a step of 8 bits at most (I. Taylor, sRGB approximations for HLSL, 2012).
vec3 encodeSrgb(vec3 c) {
    vec3 s1 = sqrt(c), s2 = sqrt(s1), s3 = sqrt(s2);
    return mix(c * 12.92, 0.585122381 * s1 + 0.783140355 * s2 - 0.368262736 * s3, greaterThan(c, vec3(0.0031308)));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 at = gl_FragCoord.xy / frame.viewportSize;
#if RAW_OCCLUSION == 1
    outColor = vec4(texelFetch(occlusion, pixel, 0).rrr, 1.0);
    return;
#endif
    vec3 color = texelFetch(scene, pixel, 0).rgb;
#if DEPTH_OF_FIELD == 1
    float depth = depthAt(pixel, 0);
    float blocks = blocksOfDepth(depth) * length(inRay);
    // The sky keeps its stars.
    float amount = depth > 0.0 ? pow(min(blocks / 512.0, 1.0), 1.5) : 0.35;
    color = mix(color, textureLod(blurred, at, 0.0).rgb, amount);
#endif
#if GOD_RAYS == 1
    color += 1.2 * textureLod(godRays, at, 0.0).r * (frame.lightColor.rgb + 0.3 * frame.glowColor.rgb);
#endif
    color = encodeSrgb(clamp(compressHighlights(color * frame.exposure), 0.0, 1.0));
    uint noise = hash2(uint(pixel.x), uint(pixel.y), 0u);
    outColor = vec4(color + (float(noise >> 16) / 65536.0 - 0.5) / 255.0, 1.0);
}
