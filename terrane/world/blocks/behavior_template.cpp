#include "terrane/world/blocks/behavior_template.h"

#include <fmt/format.h>

#include "terrane/world/changes/block_edit.h"

namespace terrane::world {
namespace {

void become(BlockUpdate& update, BlockPos pos, const std::string& block) {
    const BlockType* type = update.blocks().find(block);
    if (type) update.change(pos, SetBlock{type->id});
}

BlockBehavior usedBecomes(const BehaviorArguments& arguments) {
    const std::string block = arguments.blocks.at("block");
    return {.name = {}, .used = [block](BlockUpdate& update, BlockPos pos) { become(update, pos, block); }};
}

BlockBehavior touchedBecomes(const BehaviorArguments& arguments) {
    const std::string block = arguments.blocks.at("block"), by = arguments.blocks.at("by");
    return {.name = {}, .neighborChanged = [=](BlockUpdate& update, BlockPos pos, Face side) {
                const BlockId next = update.world().block(adjacent(pos, side));
                if (update.blocks().type(next).name == by) become(update, pos, block);
            }};
}

}  // namespace

BlockBehavior behaviorOf(const BehaviorCall& call) {
    BlockBehavior behavior = call.behavior->make(call.arguments);
    std::string arguments;
    const auto add = [&](const std::string& name, const auto& value) {
        arguments += fmt::format("{}{}={}", arguments.empty() ? "" : ",", name, value);
    };
    for (const auto& [name, block] : call.arguments.blocks) add(name, block);
    for (const auto& [name, number] : call.arguments.numbers) add(name, number);
    behavior.name = fmt::format("{}({})", call.behavior->name, arguments);
    return behavior;
}

std::vector<BehaviorTemplate> builtInTemplates() {
    return {{"used_becomes", {{.name = "block"}}, usedBecomes},
            {"touched_becomes", {{.name = "by"}, {.name = "block"}}, touchedBecomes}};
}

}  // namespace terrane::world
