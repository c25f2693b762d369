#include "terrane/gen/noise.h"

namespace terrane::gen {

std::vector<Octave> octavesOf(const NoiseCall& call) {
    std::vector<Octave> octaves;
    for (std::size_t o = 0; o < call.weights.size(); ++o) {
        if (call.weights[o] == 0.0f) continue;
        octaves.push_back({call.size << o, octaveSeedStep(o), call.weights[o]});
    }
    return octaves;
}

}  // namespace terrane::gen
