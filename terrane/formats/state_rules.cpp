#include "terrane/formats/state_rules.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "terrane/world/block_behavior.h"
#include "terrane/world/block_model.h"
#include "terrane/world/liquid_flow.h"

namespace terrane::formats {
namespace {

using world::BlockType;

// By our facing: quarter turns counterclockwise from +y.
constexpr std::array<std::string_view, 4> kDirections{"south", "east", "north", "west"};
// By our arm: -x, +x, -y, +y.
constexpr std::array<std::string_view, 4> kArmDirections{"east", "west", "north", "south"};
// Sixteenths of a clockwise turn, 0 is south.
constexpr int kRotations = 16;
// The age of a ripe plant.
int grownAge(const NamedState& state) {
    const bool hasFewAges = state.name == "minecraft:beetroots" || state.name == "minecraft:nether_wart";
    return hasFewAges ? 3 : 7;
}
constexpr std::uint16_t kLiquidForm = 15;  // level and falling

bool is(const NamedState& state, std::string_view property, std::string_view value) {
    const std::string* found = state.property(property);
    return found && *found == value;
}

int numberOf(const NamedState& state, std::string_view property, int fallback) {
    const std::string* found = state.property(property);
    int value = fallback;
    if (found) std::from_chars(found->data(), found->data() + found->size(), value);
    return value;
}

std::uint16_t formBits(const BlockType& type) {
    return type.model ? type.model->stateMask : std::uint16_t{0};
}

bool hasFacing(const BlockType& type) {
    return (formBits(type) & world::kStateFacing) != 0;
}

// Whether it is a door or a gate, whose other form is the open one.
bool opens(const BlockType& type) {
    return world::hasBehavior(type, "opens") || world::hasBehavior(type, "door");
}

std::uint16_t facingOf(const NamedState& state, bool isOpposite) {
    int facing = 0;
    if (const std::string* direction = state.property("facing")) {
        const auto at = std::ranges::find(kDirections, *direction);
        if (at == kDirections.end()) return 0;
        facing = static_cast<int>(at - kDirections.begin());
    } else if (state.property("rotation")) {
        // Clockwise from south: 4 is west, 8 north, 12 east.
        const int quarters = (std::clamp(numberOf(state, "rotation", 0), 0, kRotations - 1) + 2) / 4 % 4;
        facing = (4 - quarters) % 4;
    } else {
        return 0;
    }
    return static_cast<std::uint16_t>(isOpposite ? (facing + 2) % 4 : facing);
}

std::uint16_t armsOf(const NamedState& state) {
    std::uint16_t arms = 0;
    for (unsigned side = 0; side < kArmDirections.size(); ++side) {
        const std::string* value = state.property(kArmDirections[side]);
        const bool isThere = value && (*value == "true" || *value == "low" || *value == "tall");
        if (isThere) arms |= static_cast<std::uint16_t>(1u << (world::kStateArmShift + side));
    }
    return arms;
}

// A plant's state counts the stages that are left.
std::uint16_t growthOf(const BlockType& type, const NamedState& state) {
    const int stages = static_cast<int>(type.growth.size());
    const int grown = grownAge(state), age = std::clamp(numberOf(state, "age", grown), 0, grown);
    return static_cast<std::uint16_t>(((grown - age) * stages + grown - 1) / grown);
}

void addMissing(NamedState& state, std::string_view property, std::string_view value) {
    if (!state.property(property)) state.set(property, std::string(value));
}

void addFacing(std::uint16_t state, bool isOpposite, NamedState& named) {
    const unsigned facing = (state + (isOpposite ? 2u : 0u)) & world::kStateFacing;
    const bool isStandingSign = named.name.ends_with("_sign") && !named.name.ends_with("_wall_sign");
    if (isStandingSign)
        addMissing(named, "rotation", std::to_string((4 - facing) % 4 * 4));
    else
        addMissing(named, "facing", kDirections[facing]);
}

void addHalf(bool isUpsideDown, NamedState& named) {
    if (named.name.ends_with("_slab"))
        addMissing(named, "type", isUpsideDown ? "top" : "bottom");
    else if (named.name.ends_with("lantern"))
        addMissing(named, "hanging", isUpsideDown ? "true" : "false");
    else
        addMissing(named, "half", isUpsideDown ? "top" : "bottom");
}

}  // namespace

std::uint16_t stateOfProperties(const BlockType& type, const NamedState& state, bool isOpposite) {
    const std::uint16_t bits = formBits(type);
    std::uint16_t result = 0;
    if (hasFacing(type)) result |= facingOf(state, isOpposite);
    const bool isTop = is(state, "half", "top") || is(state, "type", "top") || is(state, "hanging", "true");
    if ((bits & world::kStateUpsideDown) != 0 && isTop) result |= world::kStateUpsideDown;
    if (opens(type) && is(state, "open", "true")) result |= world::kStateOther;
    if ((bits & world::kStateArms) != 0) result |= armsOf(state);
    if (world::hasBehavior(type, "flows")) {
        const int level = std::clamp(numberOf(state, "level", 0), 0, static_cast<int>(kLiquidForm));
        result |= static_cast<std::uint16_t>(std::min(level, 8));
    }
    if (!type.growth.empty()) result |= growthOf(type, state);
    return result;
}

void addProperties(const BlockType& type, std::uint16_t state, bool isOpposite, NamedState& named) {
    const std::uint16_t bits = formBits(type);
    if (hasFacing(type) && named.name != "minecraft:torch") addFacing(state, isOpposite, named);
    if ((bits & world::kStateUpsideDown) != 0) addHalf((state & world::kStateUpsideDown) != 0, named);
    if (opens(type)) addMissing(named, "open", (state & world::kStateOther) != 0 ? "true" : "false");
    for (unsigned side = 0; side < kArmDirections.size() && (bits & world::kStateArms) != 0; ++side) {
        const bool isThere = (state >> (world::kStateArmShift + side) & 1) != 0;
        addMissing(named, kArmDirections[side], isThere ? "true" : "false");
    }
    if (world::hasBehavior(type, "flows")) addMissing(named, "level", std::to_string(state & kLiquidForm));
    if (!type.growth.empty()) {
        const int stages = static_cast<int>(type.growth.size());
        const int grown = grownAge(named), age = grown - std::min<int>(state, stages) * grown / stages;
        addMissing(named, "age", std::to_string(age));
    }
}

}  // namespace terrane::formats
