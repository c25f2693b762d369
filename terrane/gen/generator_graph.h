// A generator as data: the graphs of its passes and what they exchange. Written by the builder, read by both
// back ends. A plain value; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "terrane/gen/graph.h"
#include "terrane/gen/noise.h"

namespace terrane::gen {

constexpr int kMaxReadOffset = 16;  // blocks: a pass sees at most the eight chunks around its own

// A value of each column that one pass writes and later ones read.
struct FieldInfo {
    std::string name;
    Type type = Type::Float;
    int writtenBy = -1;  // pass number
};

struct FieldOutput {
    std::uint32_t field;
    NodeId value;
};

// A finished pass: its graph and what it writes.
struct PassGraph {
    std::string name;
    bool is3D = false;
    Graph graph;
    std::vector<FieldOutput> fields;     // 2D passes
    std::optional<NodeId> block;         // 3D passes
    std::vector<std::uint32_t> readsAt;  // fields read with an offset
};

struct GeneratorGraph {
    std::string name;
    std::vector<FieldInfo> fields;
    std::vector<NoiseCall> noises;
    std::vector<std::string> randomNames;  // of seed slots
    std::vector<PassGraph> passes;         // the last one is 3D
};

}  // namespace terrane::gen
