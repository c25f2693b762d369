// One triangle that covers the screen, at depth 0: infinitely far.
layout(location = 0) out vec2 outScreen;  // -1…1

void main() {
    outScreen = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(outScreen, 0.0, 1.0);
}
