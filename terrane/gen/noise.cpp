#include "terrane/gen/noise.h"

#include <algorithm>

namespace terrane::gen {

std::vector<float> fadedWeights(std::vector<float> weights, std::int32_t size, std::int32_t step) {
    if (step == 1) return weights;
    for (std::size_t o = 0; o < weights.size(); ++o) {
        const float cellsPerStep = static_cast<float>(size << o) / static_cast<float>(step);
        weights[o] *= std::clamp(cellsPerStep - 1.0f, 0.0f, 1.0f);
    }
    return weights;
}

bool hasOctaves(const NoiseCall& call) {
    return std::any_of(call.weights.begin(), call.weights.end(), [](float w) { return w != 0.0f; });
}

std::vector<Octave> octavesOf(const NoiseCall& call) {
    std::vector<Octave> octaves;
    for (std::size_t o = 0; o < call.weights.size(); ++o) {
        if (call.weights[o] == 0.0f) continue;
        octaves.push_back({call.size << o, octaveSeedStep(o), call.weights[o]});
    }
    return octaves;
}

}  // namespace terrane::gen
