// Clouds before surfaces: below a camera that is above the clouds, between a camera below them and higher land, and
// around a camera inside. Premultiplied color, and coverage. MSAA_SAMPLES: of the depth.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/sky/sky_color.glsl"
#include "terrane/render/sky/clouds.glsl"
#include "terrane/render/quads/gbuffer_read.glsl"
#include "terrane/render/shading/fading.glsl"

layout(location = 1) in vec3 inRay;
layout(location = 0) out vec4 outColor;

const float kVeilBlocks = 12.0;  // a third of the light passes through so much of a thick cloud

// Share of a surface so many blocks away that the cloud around the camera hides.
float veilOver(float blocks) {
    float dense = cloudThickness(cloudPlace(cloudCamera())) / kVeilBlocks;
    return (1.0 - smoothstep(0.0, kCloudDepth, abs(cloudRise()))) * (1.0 - exp(-dense * blocks));
}

// Share of the plane's clouds that is before a surface, which gets lost in them gradually where it stands in the plane.
float shareBefore(vec3 toPoint) {
    float rise = cloudRise(), beyond = rise < 0.0 ? rise - toPoint.z : toPoint.z - rise;
    float share2 = dot(toPoint.xy, toPoint.xy) / (frame.fogDistance * frame.fogDistance);
    bool isClear = (frame.switches & kSwitchDistanceFog) == 0;
    return smoothstep(0.0, kCloudDepth, beyond) * (isClear ? 1.0 : 1.0 - fadingAt(toPoint, share2));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 direction = normalize(inRay);
    vec3 around = 0.45 * frame.horizonColor.rgb + 0.3 * frame.ambientColor.rgb + 0.45 * frame.lightColor.rgb;
    vec4 cloud = clouds(direction, skyColor(direction)), sum = vec4(0.0);
    for (int k = 0; k < MSAA_SAMPLES; ++k) {
        float depth = depthAt(pixel, k);
        vec3 toPoint = inRay * min(blocksOfDepth(depth), 1e5);
        // The sky has its clouds already.
        float before = depth > 0.0 ? kCloudShown * cloud.a * shareBefore(toPoint) : 0.0;
        float veil = veilOver(length(toPoint));
        sum += vec4(cloud.rgb, 1.0) * (before * (1.0 - veil)) + vec4(around, 1.0) * veil;
    }
    outColor = sum / float(MSAA_SAMPLES);
}
