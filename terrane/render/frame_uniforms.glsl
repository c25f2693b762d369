#include "terrane/shared/bindings.h"
#include "terrane/shared/frame.h"

layout(std140, binding = kFrameBinding) uniform FrameBlock {
    Frame frame;
};
