#include "terrane/world/behavior_parser.h"

#include <algorithm>
#include <vector>

namespace terrane::world {

void readBehaviors(ContentTable& table, BlockDescription& block, const BehaviorTable& behaviors) {
    const auto add = [&](const BehaviorPtr& behavior) {
        auto& own = block.type.behaviors;
        if (behavior && std::ranges::find(own, behavior) == own.end()) own.push_back(behavior);
    };
    const Shape shape = block.type.shape;
    const bool isPlant = shape == Shape::Cross || shape == Shape::Hash || shape == Shape::Inset;
    if (table.boolean("needs_ground", isPlant)) add(behaviors.find("plant"));
    if (!block.growth.empty()) add(behaviors.find("crop"));
    if (block.type.slots > 0) add(behaviors.find("container"));

    const toml::node* value = table.node("behaviors");
    if (!value) return;
    const toml::array* names = value->as_array();
    if (!names) return table.expected(*value, "behaviors", "an array of names");
    for (const toml::node& name : *names) {
        const auto text = name.value_exact<std::string>();
        const BehaviorPtr behavior = text ? behaviors.find(*text) : nullptr;
        if (!behavior) {
            std::vector<std::string_view> known;
            for (const BehaviorPtr& one : behaviors.behaviors()) known.push_back(one->name);
            return table.expected(name, "behaviors", fmt::format("one of {}", fmt::join(known, ", ")));
        }
        add(behavior);
    }
}

}  // namespace terrane::world
