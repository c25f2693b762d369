// Random numbers by counter: each is a function of pixel, sample and dimension. So an image depends neither
// on threads nor on how its samples are divided into runs.
#pragma once

#include <glm/vec2.hpp>

#include <cstdint>

#include "terrane/shared/hash.h"

namespace terrane::path {

struct Random {
    std::uint32_t pixel = 0, sample = 0, seed = 0;
    std::uint32_t dimension = 0;  // of the next number

    // From 0 to 1, 1 excluded: 24 bits.
    float next() {
        return static_cast<float>(shared::hash3(pixel, sample, dimension++, seed) >> 8) * 0x1p-24f;
    }
    glm::vec2 next2() {
        const float x = next();
        return {x, next()};
    }
};

}  // namespace terrane::path
