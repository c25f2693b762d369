#include "terrane/world/turned_state.h"

#include <array>

#include "terrane/world/block_model.h"

namespace terrane::world {
namespace {

using SideMap = std::array<Face, 4>;  // by side: the side that it becomes

constexpr SideMap kTurnedSides{kFaceNegY, kFacePosY, kFacePosX, kFaceNegX};
constexpr SideMap kMirroredInX{kFacePosX, kFaceNegX, kFaceNegY, kFacePosY};
constexpr SideMap kMirroredInY{kFaceNegX, kFacePosX, kFacePosY, kFaceNegY};

std::uint16_t mappedArms(std::uint16_t state, const SideMap& sides) {
    std::uint16_t arms = 0;
    for (unsigned side = 0; side < sides.size(); ++side)
        if ((state >> (kStateArmShift + side) & 1) != 0)
            arms |= static_cast<std::uint16_t>(1u << (kStateArmShift + sides[side]));
    return static_cast<std::uint16_t>((state & ~kStateArms) | arms);
}

std::uint16_t withFacing(std::uint16_t state, int facing) {
    return static_cast<std::uint16_t>((state & ~kStateFacing) | (facing & kStateFacing));
}

bool hasFacing(const BlockType& type) {
    return type.model && (type.model->stateMask & kStateFacing) != 0;
}

}  // namespace

std::uint16_t armBits(const BlockType& type) {
    return type.model ? type.model->stateMask & kStateArms : std::uint16_t{0};
}

std::uint16_t turnedState(const BlockType& type, std::uint16_t state, int turns) {
    const int quarters = turns & 3;
    if (hasFacing(type)) state = withFacing(state, (state & kStateFacing) + quarters);
    for (int turn = 0; turn < quarters && armBits(type) != 0; ++turn) state = mappedArms(state, kTurnedSides);
    return state;
}

// Facing counts quarter turns from +y: a mirror turns them the other way, and in y it swaps +y and -y as
// well.
std::uint16_t mirroredState(const BlockType& type, std::uint16_t state, MirrorAxis axis) {
    const bool isX = axis == MirrorAxis::X;
    if (hasFacing(type)) state = withFacing(state, (isX ? 0 : 2) - (state & kStateFacing));
    return armBits(type) != 0 ? mappedArms(state, isX ? kMirroredInX : kMirroredInY) : state;
}

}  // namespace terrane::world
