// Reads and changes blocks: the tables `world` and the function `pos`.
#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "terrane/game/items.h"
#include "terrane/light/chunk_light.h"
#include "terrane/rules/rules_internal.h"
#include "terrane/world/items/item_table.h"
#include "terrane/world/ray_cast.h"

namespace terrane::rules {
namespace {

constexpr std::int64_t kStepsOfFilled = 20;
constexpr std::int64_t kStepsOfFound = 4;
constexpr std::int64_t kStepsOfRayBlock = 40;

const char* reasonOf(game::EditResult result) {
    switch (result) {
        case game::EditResult::NotLoaded:
            return "not loaded";
        case game::EditResult::Claimed:
            return "claimed";
        case game::EditResult::NotAllowed:
            return "not allowed";
        default:
            return "unchanged";
    }
}

int pushResult(RuleCall& c, game::EditResult result) {
    lua_pushboolean(c.L, result == game::EditResult::Applied);
    if (result == game::EditResult::Applied) return 1;
    return 1 + c.push(std::string_view(reasonOf(result)));
}

int change(RuleCall& c, world::BlockChange change) {
    c.requireChange();
    c.charge(kStepsOfChange);
    const world::BlockPos pos = c.pos(1);
    return pushResult(c, c.session.edit({c.pack.actor, pos, std::move(change), std::nullopt, c.pack.id}));
}

int makePos(RuleCall& c) {
    constexpr const char* kNames[] = {"x", "y", "z"};
    lua_createtable(c.L, 0, 3);
    for (int k = 0; k < 3; ++k) {
        (void)c.real(k + 1, -1e10, 1e10);
        lua_pushvalue(c.L, k + 1);  // whole numbers stay whole
        lua_setfield(c.L, -2, kNames[k]);
    }
    return 1;
}

int block(RuleCall& c) {
    const world::BlockPos pos = c.pos(1);
    if (c.session.world().isMade(pos)) return c.pushBlock(c.session.world().block(pos));
    lua_pushnil(c.L);
    return 1;
}

int state(RuleCall& c) {
    const world::BlockPos pos = c.pos(1);
    if (c.session.world().isMade(pos))
        lua_pushinteger(c.L, c.session.world().blockState(pos));
    else
        lua_pushnil(c.L);
    return 1;
}

int setBlock(RuleCall& c) {
    return change(c, world::SetBlock{c.block(2), c.state(3)});
}

int setState(RuleCall& c) {
    return change(c, world::SetState{static_cast<std::uint16_t>(c.integer(2, 0, 65535))});
}

int fill(RuleCall& c) {
    c.requireChange();
    const world::BlockPos a = c.pos(1), b = c.pos(2);
    const world::BlockBox box{{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
                              {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
    const world::BlockId id = c.block(3);
    if (box.blockCount() > kMaxFillBlocks)
        lua::fail("fill: {} blocks, at most {} at once", box.blockCount(), kMaxFillBlocks);
    c.charge(kStepsOfChange + kStepsOfFilled * box.blockCount());
    const game::FillBox fill{box, id, c.state(4), {}};
    const game::BuildOutcome outcome = c.session.build({c.pack.actor, fill, c.pack.id});
    lua_pushinteger(c.L, static_cast<lua_Integer>(outcome.changed));
    if (outcome.result == game::BuildOutcome::Result::Done) return 1;
    const bool isRefused = outcome.result == game::BuildOutcome::Result::NotAllowed;
    return 1 + c.push(std::string_view(isRefused ? "not allowed" : "not loaded"));
}

// The nearest block; of several, the first in the order of z, y, x.
int findBlock(RuleCall& c) {
    const world::BlockId wanted = c.block(1);
    const world::BlockPos center = c.pos(2);
    const std::int32_t radius = c.integer(3, 0, kMaxFindRadius);
    const std::int64_t side = 2 * std::int64_t{radius} + 1;
    c.charge(kStepsOfFound * side * side * side);
    const world::World& blocks = c.session.world();
    std::optional<world::BlockPos> nearest;
    std::int64_t least = 0;
    for (std::int32_t dz = -radius; dz <= radius; ++dz)
        for (std::int32_t dy = -radius; dy <= radius; ++dy)
            for (std::int32_t dx = -radius; dx <= radius; ++dx) {
                const std::int64_t distance = dx * dx + dy * dy + dz * dz;
                if (nearest && distance >= least) continue;
                const world::BlockPos at{center.x + dx, center.y + dy, center.z + dz};
                if (!blocks.isMade(at) || blocks.block(at) != wanted) continue;
                nearest = at;
                least = distance;
            }
    if (nearest) return c.push(*nearest);
    lua_pushnil(c.L);
    return 1;
}

int ray(RuleCall& c) {
    const world::Ray along{c.point(1), c.point(2)};
    const double distance = c.real(3, 0, kMaxRayBlocks);
    c.charge(static_cast<std::int64_t>(distance * 2 + 1) * kStepsOfRayBlock);
    const auto hit = world::castRay(c.session.world(), c.session.blocks(), along, distance);
    if (!hit) {
        lua_pushnil(c.L);
        return 1;
    }
    lua_createtable(c.L, 0, 4);
    pushPos(c.L, hit->block);
    lua_setfield(c.L, -2, "pos");
    pushPos(c.L, world::adjacent(hit->block, hit->face));
    lua_setfield(c.L, -2, "before");
    setField(c.L, "block", c.session.blocks().type(c.session.world().block(hit->block)).name);
    setField(c.L, "distance", hit->distance);
    return 1;
}

int light(RuleCall& c) {
    const auto value = c.session.pipeline().lightAt(c.pos(1));
    if (!value) {
        lua_pushnil(c.L);
        return 1;
    }
    lua_createtable(c.L, 0, 4);
    const auto level = [&](int shift) { return std::int64_t{*value >> shift & 15}; };
    setField(c.L, "red", level(0));
    setField(c.L, "green", level(4));
    setField(c.L, "blue", level(8));
    setField(c.L, "sky", level(12));
    return 1;
}

int biome(RuleCall& c) {
    const world::BlockPos pos = c.pos(1);
    RulesHost& host = c.pack.host;
    c.charge(20'000);               // 0.1 ms where the chunk is another than at the last call
    c.sandbox.budget.pauseClock();  // the first one takes a tenth of a second
    if (!std::exchange(host.hasBiomes, true)) {
        const store::WorldIdentity& identity = c.session.store().identity();
        host.biomes = gen::BiomeMap::create(identity.generator, c.session.blocks(), identity.seed);
    }
    const bool isKnown = host.biomes && world::isInWorld(world::chunkOf(pos));
    const std::string name(isKnown ? host.biomes->at(pos.x, pos.y) : std::string_view());
    c.sandbox.budget.resumeClock();
    if (isKnown) return c.push(std::string_view(name));
    lua_pushnil(c.L);
    return 1;
}

// z of the topmost block of a column.
int height(RuleCall& c) {
    world::BlockPos pos = c.pos(1);
    const world::World& blocks = c.session.world();
    const world::Heights heights = blocks.heights();
    c.charge(heights.layers());
    for (pos.z = heights.top - 1; pos.z >= heights.bottom && blocks.isMade(pos); --pos.z)
        if (blocks.block(pos) != world::kAir) {
            lua_pushinteger(c.L, pos.z);
            return 1;
        }
    lua_pushnil(c.L);
    return 1;
}

int time(RuleCall& c) {
    lua_pushnumber(c.L, c.session.clock.timeDay);
    return 1;
}

int setTime(RuleCall& c) {
    c.requireChange();
    c.session.clock.timeDay = c.real(1, 0, 1);
    return 0;
}

int seed(RuleCall& c) {
    lua_pushinteger(c.L, static_cast<lua_Integer>(c.session.store().identity().seed));
    return 1;
}

int bottom(RuleCall& c) {
    lua_pushinteger(c.L, c.session.world().heights().bottom);
    return 1;
}

int top(RuleCall& c) {
    lua_pushinteger(c.L, c.session.world().heights().top);
    return 1;
}

// The items of the block at a position, such as a chest; nothing if it holds none, or is not loaded.
std::optional<world::Inventory> itemsAt(RuleCall& c, world::BlockPos pos) {
    const world::World& blocks = c.session.world();
    if (!blocks.isMade(pos) || !game::isContainer(blocks, c.session.blocks(), pos)) return std::nullopt;
    auto items = game::itemsOf(blocks, c.session.blocks(), pos);
    if (!items) return std::nullopt;
    c.charge(static_cast<std::int64_t>(items->size()) * kStepsOfFound);
    return std::move(*items);
}

// A list of tables with the item and the count of each stack.
int items(RuleCall& c) {
    const auto held = itemsAt(c, c.pos(1));
    if (!held) {
        lua_pushnil(c.L);
        return 1;
    }
    lua_createtable(c.L, 0, 0);
    lua_Integer number = 0;
    for (const world::ItemStack& stack : *held) {
        if (stack.count == 0) continue;
        lua_createtable(c.L, 0, 2);
        setField(c.L, "item", stack.item);
        setField(c.L, "count", std::int64_t{stack.count});
        lua_rawseti(c.L, -2, ++number);
    }
    return 1;
}

// Changes the items of a block and returns how many were put or taken.
int changeItems(RuleCall& c, bool puts) {
    c.requireChange();
    c.charge(kStepsOfChange);
    const world::BlockPos pos = c.pos(1);
    const std::string item = c.item(2);
    const int count = c.isMissing(3) ? 1 : c.integer(3, 0, kMaxItemCount);
    auto held = itemsAt(c, pos);
    if (!held) return c.push(std::int64_t{0});
    const int limit = c.session.blocks().items().maxStackOf(item);
    const int done =
        puts ? count - world::addItems(*held, item, count, limit) : world::takeItems(*held, item, count);
    if (done == 0) return c.push(std::int64_t{0});
    const auto result = c.session.edit(
        {c.pack.actor, pos, world::SetEntityData{world::encodeInventory(*held)}, std::nullopt, c.pack.id});
    return c.push(std::int64_t{result == game::EditResult::Applied ? done : 0});
}

int putItems(RuleCall& c) {
    return changeItems(c, true);
}
int takeItems(RuleCall& c) {
    return changeItems(c, false);
}

constexpr RuleFunction kWorld[] = {{"block", block}, {"state", state},       {"set", setBlock},
                                   {"fill", fill},   {"setState", setState}, {"find", findBlock},
                                   {"ray", ray},     {"light", light},       {"biome", biome},
                                   {"time", time},   {"setTime", setTime},   {"height", height},
                                   {"seed", seed},   {"bottom", bottom},     {"top", top},
                                   {"items", items}, {"putItems", putItems}, {"takeItems", takeItems}};
constexpr RuleFunction kPos = {"pos", makePos};

}  // namespace

void addWorldFunctions(lua_State* L) {
    lua::pushFunction(L, kPos);
    lua_setfield(L, -2, "pos");
    lua_createtable(L, 0, static_cast<int>(std::size(kWorld)));
    lua::addFunctions<RuleCall>(L, kWorld);
    lua_setfield(L, -2, "world");
}

}  // namespace terrane::rules
