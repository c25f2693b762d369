// The state of running rules, which the functions of scripts work on. On the world's thread.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/gen/generators/biomes.h"
#include "terrane/lua/block_names.h"
#include "terrane/lua/call.h"
#include "terrane/lua/sandbox.h"
#include "terrane/rules/rules.h"

namespace terrane::rules {

// Limits of a pack for each tick of 50 ms: 5 ms of instructions. The clock ends only what steps do not
// measure.
constexpr lua::Limits kLimits{.memoryBytes = std::size_t{16} << 20, .steps = 1'000'000};
constexpr std::size_t kMaxHandlers = 1000;                 // of a pack
constexpr std::size_t kMaxTimers = 10'000;                 // of a pack
constexpr std::size_t kMaxCommands = 100;                  // of a pack
constexpr std::size_t kMaxStorage = std::size_t{1} << 20;  // bytes of keys and values of a pack
constexpr std::size_t kMaxKeyBytes = 64;
constexpr std::size_t kMaxSaidBytes = 500;   // of a line of chat
constexpr int kMaxSaidLines = 100;           // of a pack in a tick
constexpr std::int32_t kMaxFindRadius = 16;  // 33³ = 35,937 blocks
constexpr std::int64_t kMaxFillBlocks = 32'768;
constexpr double kMaxRayBlocks = 64;
constexpr std::int32_t kMaxItemCount = 10'000;  // given, put or taken at once

// The events that scripts hear: all of game::Events that are no matter of screens and disks.
enum class EventKind : std::uint8_t {
    Join,
    Leave,
    Chat,
    Command,
    Place,
    Break,
    Use,
    Build,
    ItemUsed,
    Crafted,
    Claim,
    Tick,
    Random,
    Count
};

// A function of a script, by its number in the registry of its state.
struct Handler {
    EventKind kind = EventKind::Join;
    bool isBefore = false;
    int function = 0;
    std::optional<world::BlockId> block = {};  // only events of this block
    std::int64_t every = 1;                    // of ticks, only each n-th
};

struct Timer {
    std::int64_t number = 0;
    std::int64_t dueTick = 0;
    std::int64_t period = 0;  // ticks; 0: it runs once
    int function = 0;
    game::PlayerId player = game::kNoPlayer;  // for whom it acts
};

// The rules of one pack.
struct PackRules : lua::Sandbox {
    PackRules(RulesHost& rulesHost, std::string packName, game::PackId packId,
              const world::BlockRegistry& blocks)
        : Sandbox(kLimits),
          host(rulesHost),
          name(std::move(packName)),
          id(packId),
          blockNames(blocks, name) {}

    RulesHost& host;
    std::string name;
    game::PackId id;
    lua::BlockNames blockNames;
    std::vector<Handler> handlers = {};
    std::vector<Timer> timers = {};
    std::int64_t newestTimer = 0;
    std::size_t commands = 0;
    std::map<std::string, std::string> storage = {};  // texts of values (stored_value.h) by escaped key
    std::size_t storageBytes = 0;
    bool isStorageChanged = false;  // since it was passed to the store
    std::uint64_t randomState = 0;
    int linesSaid = 0;  // in this tick
    bool isSuspended = false;
    bool isDeciding = false;  // a handler of an event before its cause runs: it changes nothing
    game::PlayerId actor = game::kNoPlayer;  // whose event runs
    lua::StatePtr state = nullptr;           // destroyed first
};

struct RulesHost {
    RulesHost(game::Session& ownSession, bool logsProblems) : session(ownSession), logs(logsProblems) {}

    game::Session& session;
    bool logs;  // problems
    std::vector<std::unique_ptr<PackRules>> packs = {};
    std::vector<std::string> problems = {};
    std::map<game::PlayerId, std::string> players = {};  // that are in the game
    std::int64_t tick = 0;
    bool hasBiomes = false;  // they were asked for
    std::optional<gen::BiomeMap> biomes = {};
    std::vector<game::Subscription> subscriptions = {};
};

// Calls a function of a pack for a player and returns the text that it returns, if any. `push` pushes the
// arguments and returns their number. Suspends the pack if it fails.
using PushArguments = std::function<int(lua_State*)>;
std::optional<std::string> callFunction(PackRules& pack, int function, game::PlayerId actor,
                                        const PushArguments& push);
void suspend(PackRules& pack, const std::string& reason);

// A call from a script.
class RuleCall : public lua::Call {
  public:
    explicit RuleCall(lua_State* state)
        : Call(state), pack(static_cast<PackRules&>(sandbox)), session(pack.host.session) {}

    PackRules& pack;
    game::Session& session;

    // Arguments.
    world::BlockPos pos(int argument);  // a table {x, y, z}; rounds down
    glm::dvec3 point(int argument);
    world::BlockId block(int argument);  // by name
    std::string item(int argument);      // by name, which an item has
    std::uint16_t state(int argument);   // 0 if it is missing
    double real(int argument, double least, double most) const;
    game::PlayerId player(int argument) const;
    std::string line(int argument) const;  // one line of chat
    // Fails in a handler of an event before its cause.
    void requireChange() const;
    int keep(int argument);  // a function, for Handler::function

    // Results. Each returns 1.
    int push(std::string_view text);
    int push(world::BlockPos pos);
    int push(const glm::dvec3& point);
    int pushBlock(world::BlockId block);
    int push(std::int64_t number);
    int pushPlayer(game::PlayerId player);
};

using RuleFunction = lua::FunctionOf<RuleCall>;

// Sets fields of the table on top of the stack.
void setField(lua_State* L, const char* name, std::string_view text);
void setField(lua_State* L, const char* name, double number);
void setField(lua_State* L, const char* name, std::int64_t number);
void pushPos(lua_State* L, world::BlockPos pos);
void pushPlayer(lua_State* L, game::PlayerId player);

// Tables of functions and members, by the file that has them.
void addWorldFunctions(lua_State* L);    // world_functions.cpp: world, pos
void addPlayerFunctions(lua_State* L);   // player_functions.cpp: players, chat, commands, the type Player
void addEventFunctions(lua_State* L);    // event_functions.cpp: events, after, every, cancel, random
void addStorageFunctions(lua_State* L);  // storage_functions.cpp: storage
std::vector<std::string> playerMembers();

// Hears the events of the session for all packs.
void listen(RulesHost& host);
// Runs the timers that are due, and fills budgets again.
void runTick(RulesHost& host);

void loadStorage(PackRules& pack);
// Passes all storage that changed to the store, in one transaction with all changed blocks.
void saveStorage(RulesHost& host);
// Steps of 5 ns: what a script changes is lit, meshed, saved and sent later.
constexpr std::int64_t kStepsOfChange = 1000;

// Passes that of one pack, while the session queues saves.
void queueStorage(PackRules& pack);

}  // namespace terrane::rules
