// Wind of clouds and waves.
const vec2 kWind = vec2(5.0, 2.0);  // blocks a second, added to texture coordinates: patterns move the other way
