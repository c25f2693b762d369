#include "terrane/lua/script.h"

#include <algorithm>

#include "terrane/base/digest.h"
#include "terrane/base/log.h"
#include "terrane/gen/compile/generator_graph.h"
#include "terrane/lua/graph_call_internal.h"
#include "terrane/lua/graph_limits_internal.h"
#include "terrane/lua/state_internal.h"

namespace terrane::lua {
namespace {

struct RecordRequest {
    const std::string& generator;  // name of the graph
    const world::BlockRegistry& blocks;
    gen::GraphRequest graph;
    bool prints;  // whether print() writes to the log
};

struct Recorded {
    gen::GeneratorGraph graph;
    bool readsStep, readsHeights;
};

base::Result<Recorded> record(const Script& script, BlockNames& names, const RecordRequest& request) {
    gen::GeneratorBuilder builder(request.generator, request.blocks, request.graph);
    Recording recording(builder, names);
    // While level 0 is recorded: else each level would repeat it.
    if (request.prints && builder.step() == 1)
        recording.print = [](std::string_view line) { base::logInfo("script: {}", line); };
    const StatePtr state = makeState(recording);
    if (!state) return base::fail(base::ErrorCode::OutOfResources, "{}: no memory to run it", script.file);
    if (std::string reason = runScript(state.get(), script); !reason.empty())
        return base::fail(base::ErrorCode::BadInput, "{}", reason);
    // Before finish() compiles it, which takes longest for graphs that are too large.
    const std::string early = builder.mistakes().empty() ? unboundedWork(builder.recorded()) : "";
    if (!early.empty()) return base::fail(base::ErrorCode::BadInput, "{}: {}", script.file, early);
    auto graph = builder.finish();
    if (!graph) return base::fail(base::ErrorCode::BadInput, "{}: {}", script.file, graph.error().message);
    if (const std::string reason = unboundedWork(*graph); !reason.empty())
        return base::fail(base::ErrorCode::BadInput, "{}: {}", script.file, reason);
    return Recorded{*std::move(graph), recording.readsStep, recording.readsHeights};
}

// Replacements for names that content files do not allow, such as "pack:block".
BlockNames::Aliases aliasesOf(const std::vector<std::string>& names) {
    BlockNames::Aliases aliases;
    const auto isTaken = [&](const std::string& alias) {
        return std::find(names.begin(), names.end(), alias) != names.end() ||
               std::any_of(aliases.begin(), aliases.end(), [&](const auto& a) { return a.second == alias; });
    };
    for (const std::string& name : names) {
        std::string alias = name;
        for (char& letter : alias) {
            const bool isAllowed =
                (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') || letter == '_';
            if (!isAllowed) letter = '_';
        }
        if (alias == name) continue;
        while (isTaken(alias)) alias += '_';
        aliases.emplace(name, alias);
    }
    return aliases;
}

// A registry with only these blocks. Their appearance does not affect a graph.
base::Result<world::BlockRegistry> registryOf(const std::vector<std::string>& names,
                                              const BlockNames::Aliases& aliases) {
    std::string toml;
    for (std::string name : names) {
        if (const auto alias = aliases.find(name); alias != aliases.end()) name = alias->second;
        if (name != "missing")
            toml += fmt::format("[[block]]\nname = \"{}\"\nshape = \"cube\"\ntexture = \"stone\"\n", name);
    }
    return world::BlockRegistry::parse(toml, "blocks of a script");
}

}  // namespace

base::Result<gen::GeneratorGraph> recordScript(const Script& script, const ScriptNames& names,
                                               const world::BlockRegistry& blocks,
                                               gen::GraphRequest request) {
    BlockNames blockNames(blocks, names.pack);
    auto recorded = TERRANE_TRY(record(script, blockNames, {names.generator, blocks, request, true}));
    return std::move(recorded.graph);
}

base::Result<int> scriptVersion(const Script& script, const ScriptNames& names,
                                const world::BlockRegistry& blocks) {
    // Level 0 decides what other levels record, unless the script reads the step; the heights that it
    // declares decide what others record, unless it reads them.
    std::vector<gen::GraphRequest> requests = {{}};
    bool readsStep = false, readsHeights = false;
    BlockNames used(blocks, names.pack);
    for (std::size_t k = 0; k < requests.size(); ++k) {
        const auto first = TERRANE_TRY(record(script, used, {names.generator, blocks, requests[k], false}));
        if (first.readsStep && !readsStep) {
            readsStep = true;
            for (int level = 1; level <= world::kMaxLevel; ++level) requests.push_back({level, {}});
        }
        if (first.readsHeights && !readsHeights) {
            readsHeights = true;
            requests.push_back({0, world::Heights{world::kLowestBottom, world::kHighestTop}});
        }
    }
    const BlockNames::Aliases aliases = aliasesOf(used.used());
    const auto registry = TERRANE_TRY(registryOf(used.used(), aliases));
    std::string text;
    for (const gen::GraphRequest& request : requests) {
        BlockNames again(registry, names.pack, aliases);
        const auto recorded = TERRANE_TRY(record(script, again, {names.generator, registry, request, false}));
        text += fmt::format("{:016x}", gen::graphHash(recorded.graph));
    }
    for (const std::string& name : used.used()) text += "\n" + name;
    const auto version = static_cast<int>(base::hash64(text) & 0x7FFFFFFFu);
    return std::max(version, 1);
}

}  // namespace terrane::lua
