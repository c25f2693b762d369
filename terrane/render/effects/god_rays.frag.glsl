// Rays of the sun or moon in screen space, at a third of the size: the share of its disc that is visible along the way
// from a pixel to it (K. Mitchell, Volumetric Light Scattering as a Post-Process, 2007). Only the disc and the glow
// around it shine, so that objects in front of them cut the light into shafts.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/shared/hash.h"

layout(binding = kSceneUnit) uniform sampler2D scene;

layout(location = 0) in vec2 inScreen;
layout(location = 0) out vec4 outRays;

const int kSamples = 24;
const float kReach = 5.0;    // radii of the disc within which the sky shines
const float kSource = 0.25;  // radii of the part of the disc that light comes from: the smaller, the sharper the shafts

// Brightness of the sky as a source of rays; 0 behind surfaces and outside the image.
float emission(vec2 at, vec2 aspect, float disc) {
    vec2 inside = step(abs(at), vec2(1.0));
    float glow = exp(-0.5 * max(length((at - frame.lightOnScreen) * aspect) / disc - 1.0, 0.0));
    return inside.x * inside.y * glow * (1.0 - textureLod(scene, 0.5 + 0.5 * clamp(at, -1.0, 1.0), 0.0).a);
}

float random(uint number) {
    return float(hash2(uint(gl_FragCoord.x), uint(gl_FragCoord.y), number) >> 8) / 16777216.0;
}

void main() {
    vec2 aspect = vec2(frame.viewportSize.x / frame.viewportSize.y, 1.0);
    float disc = frame.discSine / length(frame.rayUp.xyz);  // its radius; the image is 2 high
    float away = length((inScreen - frame.lightOnScreen) * aspect);
    float share = min(kReach * disc / max(away, 1e-4), 1.0);  // of the way on which the sky shines
    // Neighboring pixels take other samples; smoothing joins them.
    float turn = 6.2831853 * random(9u), offset = random(10u);
    float sum = 0.0;
    for (int k = 0; k < kSamples; ++k) {
        // Samples lie on a spiral over the disc, in another order than along the way.
        float angle = 2.3999632 * float(k) + turn, radius = kSource * disc * sqrt((float(k) + 0.5) / float(kSamples));
        vec2 source = frame.lightOnScreen + radius * vec2(cos(angle), sin(angle)) / aspect;
        float onWay = share * (float(7 * k % kSamples) + offset) / float(kSamples);
        sum += emission(mix(source, inScreen, onWay), aspect, disc);
    }
    // Squared, so that half-open ways are darker and shafts stand out.
    float open = sum / float(kSamples);
    outRays = vec4(open * open * exp(-1.6 * away) * frame.lightRayShare);
}
