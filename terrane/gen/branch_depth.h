// Nesting depth of the branches and loops of a scheduled pass. The compiler, the executor and GLSL compilers
// recurse once per level, so GeneratorBuilder::finish() refuses passes that nest too deeply. Any thread.
#pragma once

#include <string>

#include "terrane/gen/generator_graph.h"

namespace terrane::gen {

// Levels of the schedule of a whole pass. Sequential ifs nest where one uses the result of another on one
// side alone.
constexpr int kMaxBranchDepth = 64;
// Ifs and loops along one path from a node to its arguments: no schedule of a part of the pass is deeper.
// Parts with known conditions (short_pass.h) are compiled again, and their nodes may stand deeper than in the
// whole pass. 1,024 levels of the compiler take about half a megabyte of stack.
constexpr int kMaxBranchChain = 1024;

// Levels below the root. Both functions work without recursion.
int branchDepth(const PassGraph& pass);
int branchChain(const PassGraph& pass);

// The reason if a pass nests too deeply, else empty.
std::string branchMistake(const PassGraph& pass);

}  // namespace terrane::gen
