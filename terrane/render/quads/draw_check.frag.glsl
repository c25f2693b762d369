// The value of a quad of draw_check.vert.glsl.
layout(location = 0) flat in uint value;

layout(location = 0) out uint outValue;

void main() {
    outValue = value;
}
