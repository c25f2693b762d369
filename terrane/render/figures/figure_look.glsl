// Appearance of a figure from its number, and the parts with their own colors. Needs hash.h.
#include "terrane/shared/hash.h"

const uint kPartLeg = 0u, kPartShoe = 1u, kPartBody = 2u, kPartArm = 3u, kPartScarf = 4u, kPartHead = 5u, kPartNose = 6u,
           kPartHair = 7u, kPartHairUnderCap = 8u;

const uint kHairShort = 0u, kHairLong = 1u, kHairCap = 2u, kHairBun = 3u;

// A number below `count`. `salt`: number of the choice.
uint choiceOf(uint look, uint salt, uint count) {
    return hash2(look, salt, 0x51u) % count;
}

uint hairStyleOf(uint look) {
    return choiceOf(look, 1u, 4u);
}
