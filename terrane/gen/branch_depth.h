// How deep branches and loops of a pass nest once it is scheduled. Code that walks a schedule calls itself
// for each level: the compiler, the executor, GLSL compilers. GeneratorBuilder::finish() refuses passes that
// are too deep. Any thread.
#pragma once

#include <string>

#include "terrane/gen/generator_graph.h"

namespace terrane::gen {

// Levels of the schedule of a whole pass. Sequential ifs nest where one uses the result of another on one
// side alone.
constexpr int kMaxBranchDepth = 64;
// Ifs and loops along one path from a node to its arguments. No schedule of a part of the pass is deeper:
// parts are compiled again for rows where conditions are known, and then less holds their nodes up. 1,024
// levels of the compiler take about half a megabyte of stack.
constexpr int kMaxBranchChain = 1024;

// Levels below the root. Calls itself at no level.
int branchDepth(const PassGraph& pass);
int branchChain(const PassGraph& pass);

// The reason where a pass is too deep, else empty.
std::string branchMistake(const PassGraph& pass);

}  // namespace terrane::gen
