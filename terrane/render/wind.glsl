// Wind of clouds and waves.
const vec2 kWind = vec2(5.0, 2.0);  // blocks a second; texture coordinates move so, and patterns the other way
