// Figures of players: the record that the vertex shader reads for each figure, and the measures of the legs,
// which the walk animation shares.
#ifndef TERRANE_SHARED_FIGURE_H
#define TERRANE_SHARED_FIGURE_H

#include "terrane/shared/language.h"

SHARED_BEGIN

const float kFigureLeg = 0.7f;        // blocks from the hip to the ground
const float kFigureMostSwing = 0.9f;  // radians that a leg is turned forward or back at a run

// Most figures in a draw call: 256 × 48 = 12 KiB, within the 16 KiB that every driver allows a uniform block.
const uint kMostFigures = 256u;
const uint kFigureBoxes = 14u;           // the last one of the hair, if any
const uint kVerticesPerFigureBox = 18u;  // of three faces

struct FigureRecord {
    vec4 feet;  // middle of the underside, from the corner of the camera's chunk; w: yaw of the body
    vec4 pose;  // yaw and pitch of the head, phase of the legs; w: 0 stands … 1 runs
    float swing;
    uint look;
    uint unused0, unused1;
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(FigureRecord) == 48);
}  // namespace terrane::shared
#endif
#endif
