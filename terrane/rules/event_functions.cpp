// Events, timers and chance: the table `events`, the functions `after`, `every`, `cancel` and `random`.
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>

#include "terrane/base/digest.h"
#include "terrane/base/text.h"
#include "terrane/rules/rules_internal.h"
#include "terrane/world/changes/random_ticks.h"

namespace terrane::rules {
namespace {

struct KindName {
    std::string_view name;
    bool hasBefore, hasBlock;
};
// By EventKind.
constexpr KindName kKinds[] = {{"join", false, false},    {"leave", false, false}, {"chat", true, false},
                               {"command", true, false},  {"place", true, true},   {"break", true, true},
                               {"use", true, true},       {"build", true, false},  {"itemused", false, false},
                               {"crafted", false, false}, {"claim", false, false}, {"tick", false, false},
                               {"random", false, true}};
static_assert(std::size(kKinds) == static_cast<std::size_t>(EventKind::Count));

EventKind kindAt(RuleCall& c) {
    const std::string_view name = c.text(1);
    const auto* const found = std::ranges::find(kKinds, name, &KindName::name);
    if (found != std::end(kKinds)) return static_cast<EventKind>(found - std::begin(kKinds));
    std::vector<std::string> names;
    for (const KindName& kind : kKinds) names.emplace_back(kind.name);
    lua::fail("{}: there is no event \"{}\"{}", c.function, name, base::didYouMean(name, names));
}

int addHandler(RuleCall& c, bool isBefore) {
    Handler handler{kindAt(c), isBefore};
    const KindName& kind = kKinds[static_cast<std::size_t>(handler.kind)];
    if (isBefore && !kind.hasBefore) lua::fail("before: the event \"{}\" has none: use events.on", kind.name);
    if (c.pack.handlers.size() >= kMaxHandlers)
        lua::fail("{}: more than {} handlers", c.function, kMaxHandlers);
    c.function_(2);
    if (kind.hasBlock && !c.isMissing(3)) handler.block = c.block(3);
    if (handler.kind == EventKind::Tick && !c.isMissing(3)) handler.every = c.integer(3, 1, 1'000'000);
    if (handler.kind == EventKind::Random) {
        if (!handler.block) lua::fail("on: the event \"random\" needs a block as third argument");
        c.session.events.randomTickBlocks.insert(*handler.block);
    }
    handler.function = c.keep(2);
    c.pack.handlers.push_back(handler);
    return 0;
}

int on(RuleCall& c) {
    return addHandler(c, false);
}
int before(RuleCall& c) {
    return addHandler(c, true);
}

constexpr RuleFunction kEvents[] = {{"on", on}, {"before", before}};

std::int64_t ticksOf(RuleCall& c) {
    constexpr double kTicksPerSecond = 20;
    return std::max<std::int64_t>(1, std::llround(c.real(1, 0, 1e8) * kTicksPerSecond));
}

int addTimer(RuleCall& c, bool repeats) {
    const std::int64_t ticks = ticksOf(c);
    if (c.pack.timers.size() >= kMaxTimers) lua::fail("{}: more than {} timers", c.function, kMaxTimers);
    const int function = c.keep(2);
    const std::int64_t due = c.pack.host.tick + ticks;
    // What repeats acts for nobody: it goes on when the player has left.
    const game::PlayerId player = repeats ? game::kNoPlayer : c.pack.actor;
    c.pack.timers.push_back({++c.pack.newestTimer, due, repeats ? ticks : 0, function, player});
    lua_pushinteger(c.L, c.pack.newestTimer);
    return 1;
}

int after(RuleCall& c) {
    return addTimer(c, false);
}
int every(RuleCall& c) {
    return addTimer(c, true);
}

int cancel(RuleCall& c) {
    if (!lua_isinteger(c.L, 1)) c.expected(1, "the number of a timer");
    const auto found = std::ranges::find(c.pack.timers, lua_tointeger(c.L, 1), &Timer::number);
    c.charge(static_cast<std::int64_t>(c.pack.timers.size()) / 8);
    if (found == c.pack.timers.end()) return 0;
    luaL_unref(c.L, LUA_REGISTRYINDEX, found->function);
    c.pack.timers.erase(found);
    return 0;
}

// SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t nextRandom(std::uint64_t& state) {
    std::uint64_t z = state += 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    return z ^ z >> 31;
}

int random(RuleCall& c) {
    const std::uint64_t bits = nextRandom(c.pack.randomState);
    if (c.count() == 0) {
        lua_pushnumber(c.L, static_cast<double>(bits >> 11) * 0x1p-53);
        return 1;
    }
    const std::int64_t low = c.integer(1), high = c.integer(2);
    if (high < low) lua::fail("random: {} is above {}", low, high);
    const auto count = static_cast<std::uint64_t>(high - low + 1);
    lua_pushinteger(c.L, low + static_cast<std::int64_t>(bits % count));
    return 1;
}

constexpr RuleFunction kGlobals[] = {
    {"after", after}, {"every", every}, {"cancel", cancel}, {"random", random}};

using PushFields = std::function<void(lua_State*)>;

struct Told {
    EventKind kind;
    game::PlayerId actor = game::kNoPlayer;
    std::optional<world::BlockId> block = {};
};

// Tells an event to the handlers of all packs, or until one refuses what is about to happen.
std::optional<std::string> tell(RulesHost& host, const Told& told, bool isBefore, const PushFields& fields) {
    std::optional<std::string> refusal;
    for (const auto& pack : host.packs) {
        // A handler may add handlers, which hear the next event.
        const std::size_t count = pack->handlers.size();
        for (std::size_t k = 0; k < count && !pack->isSuspended && !refusal; ++k) {
            const Handler handler = pack->handlers[k];
            const bool isOther = handler.kind != told.kind || handler.isBefore != isBefore ||
                                 (handler.block && handler.block != told.block) ||
                                 (told.kind == EventKind::Tick && host.tick % handler.every != 0);
            if (isOther) continue;
            const bool wasDeciding = std::exchange(pack->isDeciding, isBefore);
            auto answer = callFunction(*pack, handler.function, told.actor, [&](lua_State* L) {
                lua_createtable(L, 0, 6);
                fields(L);
                return 1;
            });
            pack->isDeciding = wasDeciding;
            if (isBefore) refusal = std::move(answer);
        }
    }
    saveStorage(host);
    return refusal;
}

void setPlayer(lua_State* L, game::PlayerId player) {
    pushPlayer(L, player);
    lua_setfield(L, -2, "player");
}

void setPos(lua_State* L, const char* name, world::BlockPos pos) {
    pushPos(L, pos);
    lua_setfield(L, -2, name);
}

EventKind kindOf(game::BlockAct act) {
    if (act == game::BlockAct::Break) return EventKind::Break;
    return act == game::BlockAct::Place ? EventKind::Place : EventKind::Use;
}

// The block that is placed, broken or used.
world::BlockId blockOf(const game::BlockAction& action) {
    return action.act == game::BlockAct::Place ? action.after : action.before;
}

std::optional<std::string> tellBlock(RulesHost& host, const game::BlockAction& action, bool isBefore) {
    const world::BlockRegistry& blocks = host.session.blocks();
    return tell(host, {kindOf(action.act), action.player, blockOf(action)}, isBefore, [&](lua_State* L) {
        setPlayer(L, action.player);
        setPos(L, "pos", action.pos);
        setField(L, "block", blocks.type(blockOf(action)).name);
        if (action.act == game::BlockAct::Place) setField(L, "replaced", blocks.type(action.before).name);
    });
}

std::optional<std::string> tellBuild(RulesHost& host, const game::BuildAction& action, bool isBefore) {
    constexpr std::string_view kActs[] = {"fill", "structure", "undo", "redo"};
    return tell(host, {EventKind::Build, action.player}, isBefore, [&](lua_State* L) {
        setPlayer(L, action.player);
        setField(L, "act", kActs[static_cast<std::size_t>(action.act)]);
        setPos(L, "low", action.box.low);
        setPos(L, "high", action.box.high);
        setField(L, "count", static_cast<std::int64_t>(action.blocks));
    });
}

std::optional<std::string> tellChat(RulesHost& host, const game::ChatLine& line, bool isBefore) {
    return tell(host, {EventKind::Chat, line.player}, isBefore, [&](lua_State* L) {
        setPlayer(L, line.player);
        setField(L, "text", line.text);
    });
}

std::optional<std::string> tellCommand(RulesHost& host, const game::CommandLine& line, bool isBefore) {
    return tell(host, {EventKind::Command, line.player}, isBefore, [&](lua_State* L) {
        setPlayer(L, line.player);
        setField(L, "name", line.name);
        setField(L, "args", line.arguments);
    });
}

void tellItem(RulesHost& host, const Told& told, std::string_view item, std::int64_t count) {
    (void)tell(host, told, false, [&](lua_State* L) {
        setPlayer(L, told.actor);
        setField(L, "item", item);
        if (told.kind == EventKind::Crafted) setField(L, "count", count);
    });
}

void tellClaim(RulesHost& host, const game::ClaimChanged& event) {
    const game::ColumnArea& area = event.claim.area;
    (void)tell(host, {EventKind::Claim}, false, [&](lua_State* L) {
        setField(L, "name", event.claim.name);
        setField(L, "act", std::string_view(event.isAdded ? "added" : "removed"));
        setPlayer(L, event.claim.owner);
        setPos(L, "low", {area.x0, area.y0, host.session.world().heights().bottom});
        setPos(L, "high", {area.x1, area.y1, host.session.world().heights().top - 1});
    });
}

void beginTick(PackRules& pack) {
    constexpr std::int64_t kTicksOfPrints = 200;
    const store::WorldIdentity& identity = pack.host.session.store().identity();
    pack.budget.refill();
    pack.budget.pauseClock();
    pack.linesSaid = 0;
    if (pack.host.tick % kTicksOfPrints == 0) pack.printsLeft = 20;
    // With the time of day, so that sessions of a world differ.
    const auto time = std::bit_cast<std::uint64_t>(pack.host.session.clock.timeDay);
    pack.randomState =
        base::hash64(fmt::format("{} {} {} {}", identity.seed, pack.name, pack.host.tick, time));
}

void runTimers(PackRules& pack) {
    std::vector<Timer> due;
    for (const Timer& timer : pack.timers)
        if (timer.dueTick <= pack.host.tick) due.push_back(timer);
    for (const Timer& timer : due) {
        const auto found = std::ranges::find(pack.timers, timer.number, &Timer::number);
        if (found == pack.timers.end()) continue;  // cancelled by another
        if (timer.period > 0)
            found->dueTick += timer.period;
        else
            pack.timers.erase(found);
        (void)callFunction(pack, timer.function, timer.player, [](lua_State*) { return 0; });
        if (pack.isSuspended) return;
        if (timer.period == 0) luaL_unref(pack.state.get(), LUA_REGISTRYINDEX, timer.function);
    }
}

}  // namespace

void runTick(RulesHost& host) {
    ++host.tick;
    for (const auto& pack : host.packs) {
        if (pack->isSuspended) continue;
        beginTick(*pack);
        runTimers(*pack);
    }
    (void)tell(host, {EventKind::Tick}, false, [&](lua_State* L) { setField(L, "tick", host.tick); });
}

void listen(RulesHost& host) {
    game::Events& events = host.session.events;
    const auto keep = [&](game::Subscription subscription) {
        host.subscriptions.push_back(std::move(subscription));
    };
    keep(events.joined.add([&host](const game::PlayerJoined& event) {
        host.players[event.player] = event.name;
        const bool isOperator = host.session.permissions.roleOf(event.player) == game::Role::Operator;
        if (isOperator || event.player == game::kLocalPlayer)
            for (const std::string& problem : host.problems)
                host.session.events.said.notify({event.player, problem});
        (void)tell(host, {EventKind::Join, event.player}, false,
                   [&](lua_State* L) { setPlayer(L, event.player); });
    }));
    keep(events.left.add([&host](const game::PlayerLeft& event) {
        (void)tell(host, {EventKind::Leave, event.player}, false,
                   [&](lua_State* L) { setPlayer(L, event.player); });
        host.players.erase(event.player);
    }));
    keep(events.beforeChat.add(
        [&host](game::BeforeChat& event) { event.refusal = tellChat(host, event, true); }));
    keep(events.chat.add([&host](const game::ChatLine& event) { (void)tellChat(host, event, false); }));
    keep(events.beforeCommand.add(
        [&host](game::BeforeCommand& event) { event.refusal = tellCommand(host, event, true); }));
    keep(events.command.add(
        [&host](const game::CommandLine& event) { (void)tellCommand(host, event, false); }));
    keep(events.beforeBlock.add(
        [&host](game::BeforeBlockAction& event) { event.refusal = tellBlock(host, event, true); }));
    keep(events.block.add([&host](const game::BlockAction& event) { (void)tellBlock(host, event, false); }));
    keep(events.beforeBuild.add(
        [&host](game::BeforeBuildAction& event) { event.refusal = tellBuild(host, event, true); }));
    keep(events.build.add([&host](const game::BuildAction& event) { (void)tellBuild(host, event, false); }));
    keep(events.itemUsed.add([&host](const game::ItemUsed& event) {
        tellItem(host, {EventKind::ItemUsed, event.player}, event.item, 1);
    }));
    keep(events.crafted.add([&host](const game::ItemsCrafted& event) {
        tellItem(host, {EventKind::Crafted, event.player}, event.made.item, event.made.count);
    }));
    keep(events.claim.add([&host](const game::ClaimChanged& event) { tellClaim(host, event); }));
    keep(events.tick.add([&host](const game::Ticked&) { runTick(host); }));
    keep(events.randomTick.add([&host](const game::RandomTicked& event) {
        (void)tell(host, {EventKind::Random, game::kNoPlayer, event.block}, false, [&](lua_State* L) {
            setPos(L, "pos", event.pos);
            setField(L, "block", host.session.blocks().type(event.block).name);
        });
    }));
    keep(events.saving.add([&host](const game::Saving&) {
        for (const auto& pack : host.packs) queueStorage(*pack);
    }));
}

void addEventFunctions(lua_State* L) {
    lua::addFunctions<RuleCall>(L, kGlobals);
    lua_createtable(L, 0, 2);
    lua::addFunctions<RuleCall>(L, kEvents);
    lua_setfield(L, -2, "events");
}

}  // namespace terrane::rules
