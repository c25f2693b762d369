// Figures of players, each an instance: boxes that turn about joints; x ahead, y to the left, z up, at rest with the
// feet at z = 0. Only the three faces of a box that face the camera or the light are drawn; a face has six vertices.
// PASS: surfaces, shadows or corners.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/figures/figure_look.glsl"
#include "terrane/shared/figure.h"
#if PASS == PASS_SHADOWS
#include "terrane/shared/constants.h"
#include "terrane/shared/shadow.h"

layout(std140, binding = kShadowDrawBinding) uniform ShadowDrawBlock {
    ShadowDraw shadowDraw;
};
#endif

// Not a storage buffer: OpenGL 4.5 does not guarantee any in vertex shaders.
layout(std140, binding = kFiguresBinding) uniform FigureBlock {
    FigureRecord figures[kMostFigures];
};

#if PASS != PASS_SHADOWS
layout(location = 0) out vec3 outPlace;       // at rest
layout(location = 1) flat out uvec2 outFace;  // part, axis of the normal × 2 + 1 if positive; look
#endif
#if PASS == PASS_SURFACES
layout(location = 2) flat out vec3 outNormal;
#elif PASS == PASS_CORNERS
#include "terrane/render/quads/packed_gbuffer.glsl"
#include "terrane/render/corners/corner_shade.glsl"
layout(location = 2) out vec3 outScale;
layout(location = 3) out vec3 outAdded;
#endif

const int kTrunk = 0, kHead = 1, kLeftLeg = 2, kRightLeg = 3, kLeftArm = 4, kRightArm = 5;
const float kPivots[6] = float[](0.0, 1.4, kFigureLeg, kFigureLeg, 1.27, 1.27);  // heights

const uint kFaceCorners = 0xDA4u;  // of two triangles, two bits each: 0, 1, 2, 2, 1, 3
const float kToe = 0.125;  // how far a shoe reaches ahead of the leg's axis

struct Box {
    vec3 min, max;
    int joint;
    uint part;
};

// All boxes lie within the 0.6 × 0.6 × 1.8 blocks that a player takes up.
const Box kBoxes[kFigureBoxes - 1u] = Box[](
    Box(vec3(-0.075, 0.005, 0.02), vec3(0.075, 0.14, 0.76), kLeftLeg, kPartLeg),
    Box(vec3(-0.075, -0.14, 0.02), vec3(0.075, -0.005, 0.76), kRightLeg, kPartLeg),
    Box(vec3(-0.085, 0.0, 0.0), vec3(kToe, 0.15, 0.11), kLeftLeg, kPartShoe),
    Box(vec3(-0.085, -0.15, 0.0), vec3(kToe, 0.0, 0.11), kRightLeg, kPartShoe),
    Box(vec3(-0.095, -0.15, 0.68), vec3(0.095, 0.15, 1.34), kTrunk, kPartBody),
    Box(vec3(-0.065, 0.15, 0.68), vec3(0.065, 0.27, 1.32), kLeftArm, kPartArm),
    Box(vec3(-0.065, -0.27, 0.68), vec3(0.065, -0.15, 1.32), kRightArm, kPartArm),
    Box(vec3(-0.125, -0.17, 1.29), vec3(0.125, 0.17, 1.385), kTrunk, kPartScarf),
    Box(vec3(-0.13, 0.03, 1.02), vec3(-0.095, 0.13, 1.33), kTrunk, kPartScarf),
    Box(vec3(-0.19, -0.2, 1.37), vec3(0.19, 0.2, 1.77), kHead, kPartHead),
    Box(vec3(0.19, -0.03, 1.475), vec3(0.215, 0.03, 1.525), kHead, kPartNose),
    Box(vec3(-0.21, -0.215, 1.64), vec3(0.2, 0.215, 1.8), kHead, kPartHair),
    Box(vec3(-0.22, -0.21, 1.42), vec3(-0.09, 0.21, 1.72), kHead, kPartHair));

Box boxOf(uint number, uint look) {
    uint style = hairStyleOf(look);
    if (number == kFigureBoxes - 1u) {
        if (style == kHairCap) return Box(vec3(0.18, -0.17, 1.65), vec3(0.32, 0.17, 1.68), kHead, kPartHair);
        if (style == kHairBun) return Box(vec3(-0.3, -0.08, 1.58), vec3(-0.19, 0.08, 1.74), kHead, kPartHair);
        return Box(vec3(0.0), vec3(0.0), kTrunk, kPartHair);
    }
    Box box = kBoxes[number];
    if (number == kFigureBoxes - 2u && style == kHairLong) box.min.z = 1.2;
    if (number == kFigureBoxes - 2u && style == kHairCap) box.part = kPartHairUnderCap;
    return box;
}

mat3 turnedAside(float angle) {
    float c = cos(angle), s = sin(angle);
    return mat3(c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0);
}

// Turns the forward axis upward; a hanging limb swings ahead.
mat3 turnedUp(float angle) {
    float c = cos(angle), s = sin(angle);
    return mat3(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c);
}

// Angle of the left leg; that of the right one is the opposite. A foot moves evenly over the ground, except where it
// turns.
float legAngle(float phase, float size) {
    const float kEven = 0.96;
    return asin(sin(kFigureMostSwing * size) * asin(kEven * sin(phase)) / asin(kEven));
}

struct Joint {
    mat3 turn;
    float rise;  // blocks over its place at rest
};

// The rear leg stands on its toe; the one that moves ahead is lifted.
Joint jointOf(int joint, FigureRecord figure) {
    float size = figure.pose.w, phase = figure.pose.z, leg = legAngle(phase, size);
    float rise = kFigureLeg * (cos(leg) - 1.0) + kToe * abs(sin(leg)), lift = 0.07 * size * cos(phase);
    float swing = 1.7 * sin(3.14159265 * sqrt(figure.swing));
    mat3 body = turnedAside(figure.feet.w);
    if (joint == kHead) return Joint(turnedAside(figure.pose.x) * turnedUp(0.8 * figure.pose.y), rise);
    if (joint == kLeftLeg) return Joint(body * turnedUp(leg), rise + max(lift, 0.0));
    if (joint == kRightLeg) return Joint(body * turnedUp(-leg), rise + max(-lift, 0.0));
    if (joint == kLeftArm) return Joint(body * turnedUp(-0.8 * leg), rise);
    if (joint == kRightArm) return Joint(body * turnedUp(0.8 * leg * (1.0 - figure.swing) + swing), rise);
    return Joint(body, rise);
}

void main() {
    FigureRecord figure = figures[gl_InstanceID];
    uint number = uint(gl_VertexID) / kVerticesPerFigureBox, vertex = uint(gl_VertexID) % kVerticesPerFigureBox;
    Box box = boxOf(number, figure.look);
    Joint joint = jointOf(box.joint, figure);
    vec3 pivot = vec3(0.0, 0.0, kPivots[box.joint]), origin = figure.feet.xyz + pivot + vec3(0.0, 0.0, joint.rise);
    int axis = int(vertex / 6u), u = (axis + 1) % 3, v = (axis + 2) % 3;
#if PASS == PASS_SHADOWS
    bool isPositive = dot(joint.turn[axis], shadowDraw.toLight.xyz) > 0.0;
#else
    vec3 eye = (frame.cameraPosition.xyz - origin) * joint.turn + pivot;
    bool isPositive = eye[axis] > 0.5 * (box.min[axis] + box.max[axis]);
#endif
    uint corner = kFaceCorners >> 2u * (vertex % 6u) & 3u;
    vec3 side = vec3(0.0);
    side[axis] = isPositive ? 1.0 : 0.0;
    side[u] = float(corner & 1u);
    side[v] = float(corner >> 1);
    vec3 place = mix(box.min, box.max, side), position = origin + joint.turn * (place - pivot);
#if PASS == PASS_SHADOWS
    position.xy += float(kChunkSize) * vec2(frame.cameraChunk - shadowDraw.anchorChunk);
    gl_Position = shadowDraw.toClip * vec4(position, 1.0);
#else
    gl_Position = frame.viewProjection * vec4(position, 1.0);
    outPlace = place;
    outFace = uvec2(box.part << 3 | uint(2 * axis) | (isPositive ? 1u : 0u), figure.look);
    vec3 normal = joint.turn[axis] * (isPositive ? 1.0 : -1.0);
#if PASS == PASS_SURFACES
    outNormal = normal;
#else
    const vec3 kMean = vec3(0.5);
    Surface s = Surface(linearFromSrgb(kMean), normal, 0.0, nextDirection(normal), false, true);
    vec3 toPoint = position - frame.cameraPosition.xyz;
    vec4 levels = levelsAt(position, s);
    Air air = airBefore(toPoint, levels.a);
    outAdded = displayColor(air.added);
    outScale = scaleOf(kMean, lightOf(s, levels), air, outAdded);
#endif
#endif
}
