// How distance changes colors. Needs frame_uniforms.glsl and sky_color.glsl.

// Seen by a camera in the water: nothing is farther than some thirty blocks.
vec4 throughWater(vec3 color, float blocks) {
    vec3 left = exp(-vec3(0.16, 0.075, 0.06) * blocks);
    return vec4(mix(murk(), color, left), 1.0);
}

// The share of each color that the air leaves of what lies behind it (world/air.h). Molecules take half as many powers of
// red as of green and a fifth as many as of blue; haze takes all alike, its mean density on the way by the closed form of
// world::hazeLength. `amount`: 0 where there is no air.
vec3 leftThroughAir(vec3 toPoint, float blocks, float share, float amount) {
    float rise = max(toPoint.z * air.depth.z, -80.0);
    rise = abs(rise) < 1e-3 ? 1e-3 : rise;
    float haze = air.depth.y * ((1.0 - exp(-rise)) / rise);
    float molecules = air.depth.x * clamp(1.0 - toPoint.z * air.depth.w, 0.3, 1.7);
    // The more the nearer to the end of the view, so that a short one has depth too.
    float end = 1.7 * share * share * share * share;
    float grey = exp2(-amount * (haze * blocks + end)), red = exp2(-amount * molecules * blocks);
    float green = red * red;
    return grey * vec3(red, green, green * green * red);
}

// Toward the color of the sky behind, and from 5/6 of the view on toward nothing, so that chunks come and go unseen:
// color times what is left of it, and what is left. Where no daylight comes (0…1) there is no haze: caves stay dark.
vec4 throughAir(vec3 color, vec3 toPoint, float daylight) {
    if (frame.isUnderWater != 0u) return throughWater(color, length(toPoint));
    if ((frame.switches & kSwitchDistanceFog) == 0) return vec4(color, 1.0);
    float share = length(toPoint.xy) / frame.fogDistance, blocks = length(toPoint);
    vec3 seen = leftThroughAir(toPoint, blocks, share, smoothstep(-0.1, 0.5, daylight));
    vec3 direction = toPoint / blocks;
    direction.z = max(direction.z, 0.0);
    color = mix(skyColor(direction), color, seen);
    // Loaded chunks fill a square around the camera's.
    float border = max(abs(toPoint.x), abs(toPoint.y)) / frame.fogDistance;
    float left = 1.0 - smoothstep(5.0 / 6.0, 1.0, max(border, 0.85 * share));
    return vec4(color * left, left);
}
