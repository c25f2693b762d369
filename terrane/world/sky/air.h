// A model of the air: how much light it scatters and absorbs at each height. The colors of sky, fog, sun and
// moon follow from it. All functions are pure; any thread may call them.
//
// Molecules (Rayleigh) and haze (Mie) get thinner exponentially with height; ozone lies in a layer and makes
// the blue hour blue. Light that was scattered more than once is taken as equal from all sides (S. Hillaire,
// A Scalable and Production Ready Sky and Atmosphere Rendering Technique, 2020; E. Bruneton, F. Neyret,
// Precomputed Atmospheric Scattering, 2008). All lengths are a quarter of the Earth's and all densities four
// times as large: the sky looks like the Earth's, and a mountain three kilometres away is as blue as one
// twelve kilometres away on the Earth.
//
// Lengths are in blocks, one block a metre. Altitude counts from kSeaAltitude below the sea of the world.
#pragma once

#include <glm/vec3.hpp>

namespace terrane::world {

// Where the air of a world lies, z; of the generator continents unless set.
struct AirLevels {
    float sea = 80, clouds = 360;

    bool operator==(const AirLevels&) const = default;
};

constexpr float kSeaAltitude = 16, kHazeFloor = -64;  // altitudes: of the sea; below it haze is no denser
constexpr float kPlanetRadius = 1.59e6f;              // 6,360 km / 4
constexpr float kAirTop = 25e3f;                      // altitude where space begins, 100 km / 4

constexpr float kRayleighScale = 2000;  // altitude at which the density is 1/e, 8 km / 4
constexpr float kHazeScale = 150;       // lower than the Earth's: valleys are hazier than peaks
// Scattering per block at altitude 0, four times the Earth's (5.8, 13.6, 33.1) · 10^-6. The ratios 1 : 2 : 5
// let a shader find three shares from one (distance_fog.glsl).
constexpr glm::vec3 kRayleigh{26.4e-6f, 52.8e-6f, 132e-6f};
constexpr float kHazeExtinction = 60e-6f;  // per block at altitude 0
constexpr float kHazeScattering = 54e-6f;
constexpr float kHazeForward = 0.76f;  // asymmetry of its phase function

struct AirDensity {
    float rayleigh, haze, ozone;  // 1 where they are largest
};
AirDensity airDensity(float altitude);
glm::vec3 extinction(const AirDensity& density);  // per block

// Returns the share of light that is left from space to the altitude, for a light whose direction has this
// sine of elevation. The result is 0 if the ground hides it. It is integrated along the path, which is slow
// and exact to 1 %.
glm::vec3 transmittanceToSpace(float altitude, float sine);

// These phase functions return the share of light scattered by an angle, per steradian; 1/4π on average.
float rayleighPhase(float cosine);
float hazePhase(float cosine);  // L. G. Henyey, J. L. Greenstein, Diffuse Radiation in the Galaxy, 1941

}  // namespace terrane::world
