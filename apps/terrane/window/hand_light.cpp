#include "apps/terrane/window/hand_light.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "terrane/world/environment.h"

namespace terrane::app {
namespace {

glm::vec3 displayed(const glm::vec3& linear) {
    return glm::pow(glm::clamp(linear, 0.0f, 1.0f), glm::vec3(1 / 2.2f));
}

}  // namespace

glm::vec3 lightOnHand(const game::Session& session, const glm::dvec3& eyes) {
    const light::LightValue value =
        session.pipeline().lightAt(world::blockOf(eyes)).value_or(light::kFullDaylight);
    const world::Environment sky = world::environmentAt(static_cast<float>(session.clock.timeDay));
    const auto level = [&](int component) {
        return static_cast<float>(light::levelOf(value, component)) / light::kMaxLevel;
    };
    const glm::vec3 lamps(level(light::kRed), level(light::kGreen), level(light::kBlue));
    const float day = level(light::kDaylight);
    return glm::max(displayed(day * day * (sky.ambientColor + 0.6f * sky.lightColor) + lamps * lamps),
                    glm::vec3(0.12f));
}

}  // namespace terrane::app
