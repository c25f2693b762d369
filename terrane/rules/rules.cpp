#include "terrane/rules/rules.h"

#include <algorithm>
#include <utility>

#include "terrane/base/digest.h"
#include "terrane/base/log.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/rules/rules_internal.h"
#include "terrane/store/overlay_store.h"

namespace terrane::rules {
namespace {

void addGlobals(lua_State* L) {
    addWorldFunctions(L);
    addPlayerFunctions(L);
    addEventFunctions(L);
    addStorageFunctions(L);
}

// What callKept() gets. Arguments are made there, where a lack of memory is an error of the script.
struct FunctionCall {
    int function;
    const PushArguments* push;
};

int callKept(lua_State* L) {
    const auto& call = *static_cast<const FunctionCall*>(lua_touserdata(L, 1));
    lua_rawgeti(L, LUA_REGISTRYINDEX, call.function);
    lua_call(L, (*call.push)(L), 1);
    return 1;
}

// Runs the scripts of a pack, by name.
void load(PackRules& rules, const pack::Pack& pack) {
    rules.print = [name = rules.name](std::string_view line) { base::logInfo("{}: {}", name, line); };
    loadStorage(rules);
    rules.state = lua::openState(rules, addGlobals);
    if (!rules.state) return suspend(rules, rules.name + ": no memory to run its scripts");
    for (auto file = pack.files.lower_bound(pack::kScripts);
         file != pack.files.end() && file->first.starts_with(pack::kScripts) && !rules.isSuspended; ++file) {
        rules.budget.refill();
        const std::string shown = rules.name + "/" + file->first;
        if (const std::string reason = lua::runScript(rules.state.get(), {file->second, shown});
            !reason.empty())
            suspend(rules, reason);
    }
    rules.budget.refill();
    rules.budget.pauseClock();
}

}  // namespace

std::optional<std::string> callFunction(PackRules& pack, int function, game::PlayerId actor,
                                        const PushArguments& push) {
    lua_State* L = pack.state.get();
    FunctionCall call{function, &push};
    const game::PlayerId before = std::exchange(pack.actor, actor);
    lua_pushcfunction(L, callKept);
    lua_pushlightuserdata(L, &call);
    pack.budget.resumeClock();
    const std::string reason = lua::callScript(L, 1, 1);
    pack.budget.pauseClock();
    pack.actor = before;
    if (!reason.empty()) {
        suspend(pack, reason);
        return std::nullopt;
    }
    std::optional<std::string> answer;
    if (lua_type(L, -1) == LUA_TSTRING)
        answer = std::string_view(lua_tostring(L, -1)).substr(0, kMaxSaidBytes);
    lua_pop(L, 1);
    return answer;
}

void suspend(PackRules& pack, const std::string& reason) {
    if (std::exchange(pack.isSuspended, true)) return;
    RulesHost& host = pack.host;
    if (host.logs) base::logError("{}; the rules of {} are suspended", reason, pack.name);
    host.problems.push_back(reason);
    pack.timers.clear();
    for (const auto& [player, name] : host.players) {
        const bool isOperator = host.session.permissions.roleOf(player) == game::Role::Operator;
        if (isOperator || player == game::kLocalPlayer) host.session.events.said.notify({player, reason});
    }
}

Rules::Rules(game::Session& session, const std::vector<pack::Pack>& packs, bool logs)
    : host_(std::make_unique<RulesHost>(session, logs)) {
    for (const pack::Pack& pack : packs) {
        const auto first = pack.files.lower_bound(pack::kScripts);
        if (first == pack.files.end() || !first->first.starts_with(pack::kScripts)) continue;
        session.packs.push_back(pack.info.name);
        const auto id = static_cast<game::PackId>(session.packs.size());
        host_->packs.push_back(std::make_unique<PackRules>(*host_, pack.info.name, id, session.blocks()));
        load(*host_->packs.back(), pack);
    }
    if (!host_->packs.empty()) listen(*host_);
    saveStorage(*host_);
}

Rules::~Rules() {
    host_->subscriptions.clear();
    std::erase_if(host_->session.chatCommands, [&](const game::ChatCommand& command) {
        return std::ranges::any_of(host_->packs,
                                   [&](const auto& pack) { return command.owner == pack->name; });
    });
}

const std::vector<std::string>& Rules::problems() const {
    return host_->problems;
}

base::Result<void> checkScripts(const pack::Content& content) {
    auto generators = TERRANE_TRY(gen::makeLevelGenerators("flat", *content.blocks, 1));
    const store::WorldIdentity identity{.seed = 1, .generator = "flat", .generatorVersion = 1};
    game::Session session(
        {content.blocks, std::move(generators), std::make_unique<store::MemoryStore>(identity), 0});
    const Rules rules(session, *content.packs, false);  // the caller reports the first
    if (rules.problems().empty()) return {};
    return base::fail(base::ErrorCode::BadInput, "{}", rules.problems().front());
}

std::vector<std::string> ruleFunctions() {
    lua::Sandbox sandbox;
    const lua::StatePtr state = lua::openState(sandbox, addGlobals);
    std::vector<std::string> names = lua::globalsOf(state.get());
    for (std::string& member : playerMembers()) names.push_back("Player" + member);
    std::ranges::sort(names);
    return names;
}

}  // namespace terrane::rules
