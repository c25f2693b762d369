// Generators written in Lua (docs/lua.md). A script runs once for each level of detail and records a graph,
// as gen::GeneratorBuilder does for C++; nothing of Lua runs when chunks are made.
//
// Used by code that opens a world whose generator is a script. Any thread: each call has a Lua state of its
// own. Scripts are untrusted: they reach no files, no clock and no other script, and memory, steps, time and
// the size of the recording are limited (graph_limits_internal.h). The same script gives the same graph on
// every machine.
#pragma once

#include <string>

#include "terrane/base/result.h"
#include "terrane/gen/compile/generator_graph.h"
#include "terrane/lua/sandbox.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::lua {

struct ScriptNames {
    std::string generator;  // name of the graph
    std::string pack;       // block "x" is "PACK:x" if the registry has it, else "x"; empty: only "x"
};

// Returns a graph. An error is one line, "FILE:LINE: reason", or "FILE: reason" if it concerns the whole
// generator.
[[nodiscard]] base::Result<gen::GeneratorGraph> recordScript(const Script& script, const ScriptNames& names,
                                                             const world::BlockRegistry& blocks,
                                                             gen::GraphRequest request = {});

// Returns 1…2^31 − 1: a hash of everything that the script records (at level 0; at all levels if it reads the
// step; for the heights that it declares, and for the tallest world if it reads the world's heights) and of
// the names of its blocks. It does not depend on the other blocks of the registry, nor on names of passes,
// comments or layout. Saves store it as the generator's version. print() of the script writes nothing.
[[nodiscard]] base::Result<int> scriptVersion(const Script& script, const ScriptNames& names,
                                              const world::BlockRegistry& blocks);

}  // namespace terrane::lua
