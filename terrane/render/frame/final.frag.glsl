// From the scene to the screen: depth of field, god rays, bloom, then tone.glsl. DEPTH_OF_FIELD, GOD_RAYS, BLOOM: 1 adds them.
// RAW_OCCLUSION: 1 shows the ambient occlusion instead. MSAA_SAMPLES: of the depth.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/frame/tone.glsl"

layout(binding = kSceneUnit) uniform sampler2D scene;
#if DEPTH_OF_FIELD == 1
#include "terrane/render/quads/gbuffer_read.glsl"
layout(binding = kDepthOfFieldUnit) uniform sampler2D blurred;
#endif
#if GOD_RAYS == 1
layout(binding = kGodRaysUnit) uniform sampler2D godRays;
#endif
#if BLOOM == 1
layout(binding = kBloomUnit) uniform sampler2D bloom;
#endif
#if RAW_OCCLUSION == 1
layout(binding = kOcclusionUnit) uniform sampler2D occlusion;
#endif

layout(location = 1) in vec3 inRay;
layout(location = 0) out vec4 outColor;

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
#if BLOOM == 1
    // Strong around small lights, and no fog where all shines.
    vec3 spread = textureLod(bloom, at, 0.0).rgb;
    color += spread * (4.0 / (1.0 + 8.0 * max(max(spread.r, spread.g), spread.b))) / frame.exposure.rgb;
#endif
    outColor = vec4(screenColor(color, pixel), 1.0);
}
