// The wind that clouds and waves go with.
const vec2 kWind = vec2(5.0, 2.0);  // blocks a second; patterns are read at places that move so, and go the other way
