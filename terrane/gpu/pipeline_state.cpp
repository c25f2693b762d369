#include "terrane/gpu/pipeline_state.h"

#include <epoxy/gl.h>

namespace terrane::gpu {
namespace {

// Bits of more samples than any driver has. Differs from the value of a mask that is off.
constexpr GLbitfield kAllSamples = 0xffff;

void enable(GLenum capability, bool isOn) {
    (isOn ? glEnable : glDisable)(capability);
}

GLenum functionOf(DepthTest test) {
    switch (test) {
        case DepthTest::Less:
            return GL_LESS;
        case DepthTest::Equal:
            return GL_EQUAL;
        case DepthTest::Greater:
            return GL_GREATER;
        case DepthTest::Off:
        case DepthTest::Always:
            break;
    }
    return GL_ALWAYS;
}

// Blend factor of the target.
GLenum shareOfTarget(Blending blending) {
    if (blending == Blending::Over) return GL_ONE_MINUS_SRC_ALPHA;
    return blending == Blending::Through ? GL_SRC1_COLOR : GL_ZERO;
}

}  // namespace

void Pipeline::set(const PipelineState& state) {
    if (isKnown_ && state == current_) return;
    const auto differs = [&](auto member) { return !isKnown_ || state.*member != current_.*member; };
    // Depths are 0…1, as they lie in targets.
    if (!isKnown_) glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    if (differs(&PipelineState::depthTest)) {
        enable(GL_DEPTH_TEST, state.depthTest != DepthTest::Off);
        glDepthFunc(functionOf(state.depthTest));
    }
    if (differs(&PipelineState::writesDepth)) glDepthMask(state.writesDepth ? GL_TRUE : GL_FALSE);
    if (differs(&PipelineState::clampsDepth)) enable(GL_DEPTH_CLAMP, state.clampsDepth);
    if (differs(&PipelineState::depthRange)) glDepthRangef(state.depthRange.x, state.depthRange.y);
    if (differs(&PipelineState::blending)) {
        enable(GL_BLEND, state.blending != Blending::Off);
        glBlendFunc(GL_ONE, shareOfTarget(state.blending));
    }
    if (differs(&PipelineState::cullsBackFaces)) enable(GL_CULL_FACE, state.cullsBackFaces);
    if (!isKnown_) glSampleMaski(0, kAllSamples);
    if (differs(&PipelineState::readsSampleId)) enable(GL_SAMPLE_MASK, state.readsSampleId);
    current_ = state;
    isKnown_ = true;
}

}  // namespace terrane::gpu
