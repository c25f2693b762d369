// Sea level of all generators whose land has a sea.
#pragma once

namespace terrane::gen {

constexpr int kSeaLevel = 80;  // z of the highest water

}  // namespace terrane::gen
