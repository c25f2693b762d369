// A custom behavior: iron that rusts next to water, and rust that falls. Prints the effect of an edit. Usage:
// own_behavior
#include <cstdio>
#include <memory>
#include <vector>

#include "terrane/world/blocks/block_behavior.h"
#include "terrane/world/changes/block_edit.h"

namespace {

using namespace terrane;

constexpr const char* kBlocks = R"(
block = [
    { name = "iron", shape = "cube", texture = "iron", behaviors = ["rusts"] },
    { name = "rust", shape = "cube", texture = "rust", behaviors = ["falling"] },
    { name = "water", shape = "liquid", texture = "water", alpha = "blend", opacity = 1, surface_height = 0.75 },
]
)";

void rust(world::BlockUpdate& update, world::BlockPos pos, world::Face side) {
    const world::BlockId next = update.world().block(world::adjacent(pos, side));
    if (update.blocks().type(next).name == "water")
        update.change(pos, world::SetBlock{update.blocks().find("rust")->id});
}

}  // namespace

int main() {
    world::BehaviorTable behaviors = world::builtInBehaviors();
    behaviors.add({.name = "rusts", .neighborChanged = rust});
    const auto blocks = world::BlockRegistry::parse(kBlocks, "blocks", behaviors);
    if (!blocks) return std::fprintf(stderr, "%s\n", blocks.error().message.c_str()), 1;

    world::World world;
    world.insert({0, 0}, std::make_shared<world::Chunk>());
    std::vector<world::BlockEdit> edits;
    const auto put = [&](world::BlockPos pos, const char* name) {
        edits.clear();
        world::applyChange(world, *blocks, pos, world::SetBlock{blocks->find(name)->id}, edits);
    };
    put({8, 8, 40}, "iron");
    put({9, 8, 40}, "water");
    for (const world::BlockEdit& edit : edits) {
        std::printf("%d,%d,%d: %s becomes %s\n", edit.pos.x, edit.pos.y, edit.pos.z,
                    blocks->type(edit.before).name.c_str(), blocks->type(edit.after).name.c_str());
    }
}
