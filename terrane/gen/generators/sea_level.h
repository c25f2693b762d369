// What generators of land with a sea have in common.
#pragma once

namespace terrane::gen {

constexpr int kSeaLevel = 80;  // z of the highest water

}  // namespace terrane::gen
