// The state that functions of a script share while it runs: the generator that it records, the open pass, the
// used part of its limits. Each Lua state has one Recording. One thread uses it.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/gen/language/builder.h"
#include "terrane/lua/block_names.h"
#include "terrane/lua/graph_limits_internal.h"
#include "terrane/lua/object_internal.h"
#include "terrane/lua/sandbox.h"

namespace terrane::lua {

// A gen::Var without its type.
struct Variable {
    Kind kind;
    std::function<gen::Value()> read;
    std::function<void(gen::Value)> write;
};

struct Recording : Sandbox {
    Recording(gen::GeneratorBuilder& generator, BlockNames& names) : builder(generator), blocks(names) {}

    gen::GeneratorBuilder& builder;
    BlockNames& blocks;

    // The open pass. Null outside of the functions that scripts give to pass2D, pass3D and drainage.
    gen::Pass* pass = nullptr;
    std::uint32_t passNumber = 0;  // counts passes from 1: values know theirs
    std::vector<Variable> variables;
    std::size_t passCount = 0;
    std::size_t chargedNodes = 0;  // nodes of the open pass that were counted as steps

    std::vector<Kind> fields;  // by number
    std::size_t drainageCount = 0, voxelCount = 0;
    std::set<std::string, std::less<>> seedNames;
    bool hasTrees = false;
    bool readsStep = false;     // so that levels may record different passes
    bool readsHeights = false;  // and worlds of different heights

    // Returns whether a value of the pass with this number can be used now.
    bool isOpenPass(std::uint32_t number) const { return pass != nullptr && number == passNumber; }
};

// Returns the recording of a state from makeState().
inline Recording& recordingOf(lua_State* L) {
    return static_cast<Recording&>(sandboxOf(L));
}

}  // namespace terrane::lua
