// Axes across the direction of a light. A pure function; any thread.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace terrane::render {

// Matrix whose rows are unit axes: x and y across the light, z toward it. `toward`: to the light, unit
// length.
template <class T>
glm::mat<3, 3, T, glm::defaultp> lightAxes(const glm::vec<3, T, glm::defaultp>& toward) {
    using Vec3 = glm::vec<3, T, glm::defaultp>;
    const Vec3 other = std::abs(toward.z) < static_cast<T>(0.9) ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
    const Vec3 across = glm::normalize(glm::cross(other, toward));
    return glm::transpose(glm::mat<3, 3, T, glm::defaultp>(across, glm::cross(toward, across), toward));
}

}  // namespace terrane::render
