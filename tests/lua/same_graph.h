// Whether a script and C++ record the same graph, node by node.
#pragma once

#include <functional>
#include <string>

#include "terrane/gen/compile/generator_graph.h"
#include "tests/lua/lua_fixture.h"

namespace terrane::lua {

using gen::Float;
using gen::GeneratorBuilder;
using gen::Pass;

// Hash of a generator whose first pass is what is compared.
inline std::uint64_t hashOf(const std::function<void(GeneratorBuilder&)>& write, int level) {
    GeneratorBuilder builder("test", contentBlocks(), level);
    write(builder);
    builder.pass3D("last", [](Pass&) {});
    const auto graph = builder.finish();
    EXPECT_TRUE(graph) << graph.error().message;
    return graph ? gen::graphHash(*graph) : 0;
}

inline std::uint64_t hashOfScript(const std::string& text, int level) {
    const auto graph = recorded(text + "\ng:pass3D(\"last\", function() end)", level);
    EXPECT_TRUE(graph) << graph.error().message << "\n" << text;
    return graph ? gen::graphHash(*graph) : 0;
}

inline Float f(Pass& p) {
    const gen::Int x = p.x(), y = p.y();
    return p.random2D("f", x, y);
}
// Declares the same f for scripts, and begins a pass that writes what follows to a field.
constexpr const char* kPreamble = R"(
local result = g:field("result", "float")
local function f(p) return p:random2D("f", p.x, p.y) end
local function v2(p) local a = f(p) return vec2(a, a * 2) end
local function v3(p) local a = f(p) return vec3(a, a * 2, a * 3) end
local function ofBool(b) return select(b, 1.0, 0.0) end
g:pass2D("land", function(p) p:set(result, )";

}  // namespace terrane::lua
