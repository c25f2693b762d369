#include "terrane/render/frame_uniforms.glsl"
#include "terrane/render/sky_color.glsl"

layout(location = 0) in vec2 inScreen;
layout(location = 0) out vec4 outColor;

void main() {
    vec4 nearPoint = frame.inverseViewProjection * vec4(inScreen, 1.0, 1.0);
    vec3 direction = normalize(nearPoint.xyz / nearPoint.w - frame.cameraPosition.xyz);
    if (uint(frame.horizonColor.w) != kViewColor) {
        outColor = vec4(0.0, 0.0, 0.0, 1.0);
        return;
    }
    float angle = acos(clamp(dot(direction, frame.lightDirection.xyz), -1.0, 1.0));
    float disc = 1.0 - smoothstep(0.92, 1.0, angle / frame.lightColor.w);
    outColor = vec4(skyColor(direction) + 6.0 * disc * frame.lightColor.rgb, 1.0);
}
