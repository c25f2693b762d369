#include "apps/terrane/window/hud/hand_view.h"

#include <imgui.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/terrane/window/imgui_layer.h"
#include "terrane/world/sky/environment.h"

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

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kStride = 2.4;     // blocks per two steps
constexpr double kEverySecond = 8;  // rate of change of the sway, per second
constexpr glm::vec3 kSkin{214, 160, 122}, kSleeve{58, 98, 138};

ImU32 lit(glm::vec3 color, const glm::vec3& light, float shade) {
    const glm::vec3 c = glm::clamp(color * light * shade, 0.0f, 255.0f);
    return IM_COL32(static_cast<int>(c.x), static_cast<int>(c.y), static_cast<int>(c.z), 255);
}

ImVec2 pointAt(glm::vec2 p) {
    return {p.x, p.y};
}

// Draws a part of the arm as a long box: a lit top and a darker side. `from` and `to` are the centers of its
// ends.
void drawArmPart(ImDrawList& draw, glm::vec2 from, glm::vec2 to, float width, const ImU32 (&colors)[2]) {
    const glm::vec2 along = to - from;
    const float length = std::max(std::sqrt(along.x * along.x + along.y * along.y), 1.0f);
    const glm::vec2 across = glm::vec2(along.y, -along.x) * (width / 2 / length);
    draw.AddQuadFilled(pointAt(from - across), pointAt(to - across), pointAt(to + across * 0.2f),
                       pointAt(from + across * 0.2f), colors[0]);
    draw.AddQuadFilled(pointAt(from + across * 0.2f), pointAt(to + across * 0.2f), pointAt(to + across),
                       pointAt(from + across), colors[1]);
}

}  // namespace

void HandView::advance(double seconds, double walked, bool sways) {
    swingSeconds_ = std::max(0.0, swingSeconds_ - seconds);
    const bool isWalking = sways && walked > 0.2 * seconds && walked < 20 * seconds;
    swayShare_ += ((isWalking ? 1.0 : 0.0) - swayShare_) * (1 - std::exp(-kEverySecond * seconds));
    if (isWalking) stride_ = std::fmod(stride_ + walked / kStride * 2 * kPi, 2 * kPi);
}

void HandView::draw(const Screen& screen, unsigned image, const glm::vec3& light) const {
    const float scale = std::min(screen.width / 1280, screen.height / 720);
    const double swung = std::sin(kPi * (swingSeconds_ / kSwingSeconds));
    const glm::vec2 sway(static_cast<float>(std::sin(stride_) * 14 * swayShare_),
                         static_cast<float>(std::abs(std::cos(stride_)) * 12 * swayShare_));
    const glm::vec2 moved = sway + glm::vec2(-120, 60) * static_cast<float>(swung);
    const glm::vec2 corner(screen.width, screen.height);
    const glm::vec2 hand = corner + (glm::vec2(-215, -130) + moved) * scale;
    const glm::vec2 shoulder = corner + (glm::vec2(10, 150) + moved * 0.3f) * scale;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const glm::vec2 wrist = hand + (shoulder - hand) * 0.3f;
    drawArmPart(draw, shoulder, wrist, 92 * scale, {lit(kSleeve, light, 1), lit(kSleeve, light, 0.66f)});
    drawArmPart(draw, wrist, hand, 80 * scale, {lit(kSkin, light, 1), lit(kSkin, light, 0.72f)});
    if (image == 0) return;
    const float side = 190 * scale;
    const glm::vec2 min = hand - glm::vec2(side * 0.62f, side * 0.72f);
    const ImU32 tint = lit(glm::vec3(255), glm::min(light * 1.15f, 1.0f), 1);
    draw.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(image)), pointAt(min),
                  pointAt(min + side), {0, 0}, {1, 1}, tint);
}

}  // namespace terrane::app
