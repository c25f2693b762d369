// Arithmetic on eight light levels at once: two blocks of four components, 4 bits each, in 32 bits. Split
// into even and odd nibbles they are bytes with room for a borrow. For shaders; C++ has it for tests.
#ifndef TERRANE_SHARED_PACKED_LIGHT_LEVELS_H
#define TERRANE_SHARED_PACKED_LIGHT_LEVELS_H

#include "terrane/shared/language.h"

SHARED_BEGIN

const uint kEvenLevels = 0x0F0F0F0Fu;
const uint kBorrowBits = 0x10101010u;

// Four levels, a byte each.

// 0x0F in the bytes where a >= b.
SHARED_FN uint maskNotBelow(uint a, uint b) {
    uint borrow = ((a | kBorrowBits) - b) & kBorrowBits;
    return borrow - (borrow >> 4);
}

SHARED_FN uint maxOfBytes(uint a, uint b) {
    uint mask = maskNotBelow(a, b);
    return (a & mask) | (b & ~mask);
}

// a - b, at least 0.
SHARED_FN uint lessOfBytes(uint a, uint b) {
    return ((a | kBorrowBits) - b) & maskNotBelow(a, b);
}

// Eight levels, a nibble each.

SHARED_FN uint maxLevels(uint a, uint b) {
    return maxOfBytes(a & kEvenLevels, b & kEvenLevels) |
           maxOfBytes((a >> 4) & kEvenLevels, (b >> 4) & kEvenLevels) << 4;
}

// Each level minus the loss, at least 0. `loss` has the same number in all four bytes or in the two bytes of
// a block: it applies to even and odd nibbles alike.
SHARED_FN uint lessLevels(uint levels, uint loss) {
    return lessOfBytes(levels & kEvenLevels, loss) | lessOfBytes((levels >> 4) & kEvenLevels, loss) << 4;
}

// Loss of each level in a block of this opacity: 1 + opacity, where 15 stands for 16, since no level is
// higher.
SHARED_FN uint lossOfOpacity(uint opacity) {
    return opacity < 15u ? opacity + 1u : 15u;
}

SHARED_END
#endif
