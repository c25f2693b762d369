#include "terrane/world/behavior_parser.h"

#include <algorithm>
#include <vector>

namespace terrane::world {
namespace {

std::vector<std::string_view> templateNames(const BehaviorTable& behaviors) {
    std::vector<std::string_view> names = behaviors.names();
    std::erase_if(names, [&](std::string_view name) { return !behaviors.findTemplate(name); });
    return names;
}

BehaviorCall readCall(ContentTable& table, const toml::table& node, const BehaviorTable& behaviors) {
    const auto name = node["name"].value_exact<std::string>();
    BehaviorCall call;
    call.line = static_cast<int>(node.source().begin.line);
    call.behavior = name ? behaviors.findTemplate(*name) : nullptr;
    if (!call.behavior) {
        const toml::node* given = node.get("name");
        table.expected(given ? *given : node, "behaviors.name",
                       fmt::format("one of {}", fmt::join(templateNames(behaviors), ", ")));
        return call;
    }
    std::vector<std::string> known{"name"};
    for (const BehaviorParameter& parameter : call.behavior->parameters) {
        const std::string key = fmt::format("behaviors.{}", parameter.name);
        known.push_back(parameter.name);
        const toml::node* value = node.get(parameter.name);
        if (!value) {
            table.wrong(call.line, key, fmt::format("missing ({} requires it)", *name));
        } else if (parameter.kind == BehaviorParameter::Kind::Number) {
            call.arguments.numbers[parameter.name] = table.realOf(*value, key, parameter.min, parameter.max);
        } else {
            const auto block = value->value_exact<std::string>();
            if (!block) table.expected(*value, key, "the name of a block");
            call.arguments.blocks[parameter.name] = block.value_or("");
        }
    }
    table.inner(node).rejectUnknown(known, "behaviors.");
    return call;
}

}  // namespace

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
    if (!names) return table.expected(*value, "behaviors", "an array of names and tables");
    for (const toml::node& name : *names) {
        if (const toml::table* call = name.as_table()) {
            block.calls.push_back(readCall(table, *call, behaviors));
            if (!block.calls.back().behavior) return;
            continue;
        }
        const auto text = name.value_exact<std::string>();
        const BehaviorPtr behavior = text ? behaviors.find(*text) : nullptr;
        if (!behavior)
            return table.expected(name, "behaviors",
                                  text && behaviors.findTemplate(*text)
                                      ? fmt::format("{{ name = \"{}\", ... }}", *text)
                                      : fmt::format("one of {}", fmt::join(behaviors.names(), ", ")));
        add(behavior);
    }
}

}  // namespace terrane::world
