// Draws the pattern of draw_check.cpp: quads of one pixel, whose numbers follow each other in a draw.
#include "terrane/shared/bindings.h"
#include "terrane/shared/draw_check.h"
#include "terrane/shared/mesh_section.h"

layout(location = kDrawRecordAttribute) in ivec4 drawRecord;  // DrawRecord

layout(location = 0) flat out uint outValue;

void main() {
    uint quad = uint(gl_VertexID) >> 2, number = uint(drawRecord.w) - kFirstListedQuad + quad;
    vec2 corner = vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1);
    if (corner.x == 0.0) corner.x = leftEdgeOf(uint(drawRecord.z));
    vec2 pixel = vec2(number % kCheckSide, number / kCheckSide);
    gl_Position = vec4(2.0 * (pixel + corner) / float(kCheckSide) - 1.0, 0.5, 1.0);
    outValue = checkValue(drawRecord.xy, quad);
}
