#include "terrane/lua/state_internal.h"

#include <algorithm>

#include "terrane/lua/graph_call_internal.h"

namespace terrane::lua {
namespace {

void addGeneratorGlobals(lua_State* L) {
    addFunctions(L, expressionFunctions());
    makeObjectTypes(L);
    pushObject(L, {Tag::Generator, 0, {}});
    lua_setfield(L, -2, "g");
}

}  // namespace

StatePtr makeState(Recording& recording) {
    return openState(recording, addGeneratorGlobals);
}

std::vector<std::string> scriptFunctions() {
    Sandbox sandbox;
    const StatePtr state = openState(sandbox, addGeneratorGlobals);
    std::vector<std::string> names = globalsOf(state.get());
    for (const char* member : {"Pass.x", "Pass.y", "Pass.z", "Pass.step", "Generator.step",
                               "Generator.bottom", "Generator.top", "Variable.value"})
        names.emplace_back(member);
    const auto add = [&](const char* prefix, std::span<const GraphFunction> functions) {
        for (const GraphFunction& function : functions) names.push_back(std::string(prefix) + function.name);
    };
    add("Pass:", passMethods());
    add("Pass:", noiseMethods());
    add("Generator:", generatorMethods());
    add("Expression:", comparisons());
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace terrane::lua
