#include "apps/terrane/window/input.h"

#include <gtest/gtest.h>

namespace terrane::app {
namespace {

// The inputs that are set, as bits.
unsigned inputsOf(const std::optional<Gamepad>& pad) {
    float inputs[ImGuiNavInput_COUNT];
    std::fill(std::begin(inputs), std::end(inputs), 0.7f);  // of the back end
    setPadNavigation(pad, inputs);
    unsigned bits = 0;
    for (int k = 0; k < ImGuiNavInput_COUNT; ++k)
        if (inputs[k] != 0) bits |= 1u << k;
    return bits;
}

TEST(PadNavigation, EachButtonDoesWhatItShows) {
    EXPECT_EQ(inputsOf(std::nullopt), 0u);
    EXPECT_EQ(inputsOf(Gamepad{}), 0u);
    EXPECT_EQ(inputsOf(Gamepad{.south = true}), 1u << ImGuiNavInput_Activate);
    EXPECT_EQ(inputsOf(Gamepad{.east = true}), 1u << ImGuiNavInput_Cancel);
    EXPECT_EQ(inputsOf(Gamepad{.west = true, .north = true, .start = true}), 0u);
    EXPECT_EQ(inputsOf(Gamepad{.up = true}), 1u << ImGuiNavInput_DpadUp);
    EXPECT_EQ(inputsOf(Gamepad{.down = true}), 1u << ImGuiNavInput_DpadDown);
    EXPECT_EQ(inputsOf(Gamepad{.left = true}), 1u << ImGuiNavInput_DpadLeft);
    EXPECT_EQ(inputsOf(Gamepad{.right = true}), 1u << ImGuiNavInput_DpadRight);
}

TEST(PadNavigation, TheLeftStickMovesToo) {
    EXPECT_EQ(inputsOf(Gamepad{.leftX = -1}), 1u << ImGuiNavInput_DpadLeft);
    EXPECT_EQ(inputsOf(Gamepad{.leftX = 0.8f}), 1u << ImGuiNavInput_DpadRight);
    EXPECT_EQ(inputsOf(Gamepad{.leftY = 1}), 1u << ImGuiNavInput_DpadUp);
    EXPECT_EQ(inputsOf(Gamepad{.leftY = -0.8f}), 1u << ImGuiNavInput_DpadDown);
    EXPECT_EQ(inputsOf(Gamepad{.leftX = 0.3f, .leftY = 0.3f}), 0u) << "tilted a little";
}

}  // namespace
}  // namespace terrane::app
