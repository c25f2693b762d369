// Needs frame_uniforms.glsl.

// How far a point has faded into the sky at the end of the view, 0…1. Loaded chunks fill a square around the camera's.
// `share2`: square of the share of the view's distance.
float fadingAt(vec3 toPoint, float share2) {
    float border = max(abs(toPoint.x), abs(toPoint.y)) / frame.fogDistance;
    return smoothstep(5.0 / 6.0, 1.0, max(border, 0.85 * sqrt(share2)));
}
