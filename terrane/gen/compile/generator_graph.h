// A generator as data: the graphs of its passes and the fields that they exchange. The builder writes it, and
// both back ends read it. A plain value; any thread may use it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "terrane/gen/compile/graph.h"
#include "terrane/gen/cpu/shape_table.h"
#include "terrane/gen/drainage/drainage.h"
#include "terrane/gen/noise/noise.h"
#include "terrane/shared/generation.h"
#include "terrane/world/heights.h"

namespace terrane::gen {

using shared::kMaxReadOffset;

// A value of each column that one pass writes and later ones read.
struct FieldInfo {
    std::string name;
    Type type = Type::Float;
    int writtenBy = -1;  // pass number
};

struct FieldOutput {
    std::uint32_t field;
    NodeId value;
    // In a 3D pass: holds in one voxel of each column, which writes; elsewhere the value is 0.
    std::optional<NodeId> isWritten = {};
};

// Fields that say which shape has its foot in a column, and at which height.
struct StampCall {
    std::uint32_t shape, base;
    bool operator==(const StampCall&) const = default;
};

// A finished pass: its graph and its outputs.
struct PassGraph {
    std::string name;
    bool is3D = false;
    Graph graph;
    std::vector<FieldOutput> fields;
    std::optional<NodeId> block;         // 3D passes
    std::vector<std::uint32_t> readsAt;  // fields read with an offset
    bool readsBlocksAt = false;          // blocks of the 3D pass before, read with an offset
    std::vector<StampCall> stamps;       // by imm of Op::Stamp
};

// Outputs of a pass: values of fields with their conditions, then the block.
std::vector<NodeId> outputsOf(const PassGraph& pass);

// A drainage map: how heights are computed at its nodes, by a pass with one field that calls noises and
// hashes of its own. With valleys it has a second field, the gradients.
struct DrainageGraph {
    std::string name;
    DrainageSpec spec;
    std::vector<NoiseCall> noises;
    std::vector<std::string> hashNames;
    PassGraph heights;

    bool hasValleys() const { return heights.fields.size() == 2; }
};
struct TintGraph;  // builder.h

// Which graph of a generator to record.
struct GraphRequest {
    int level = 0;
    world::RequestedHeights heights = {};  // else those that the generator declares, else 0…255
};

struct GeneratorGraph {
    std::string name;
    int level = 0;           // of the chunks it makes
    world::Heights heights;  // likewise
    std::vector<FieldInfo> fields;
    std::vector<NoiseCall> noises;
    std::vector<std::string> hashNames;  // of seed slots
    std::vector<DrainageGraph> drainages;
    std::vector<PassGraph> passes;             // the last one is 3D
    std::shared_ptr<const ShapeTable> shapes;  // null if no pass stamps
    std::shared_ptr<const TintGraph> tint;     // null: the generator has none
};

// Returns the last 3D pass before `pass`, whose blocks it reads; -1 if there is none.
int last3DPassBefore(const GeneratorGraph& generator, int pass);
// Returns the number of passes that the chunks around a chunk must have done before it runs `pass`; 0 if it
// reads nothing of them.
int passesNeededAround(const GeneratorGraph& generator, int pass);
// Returns the number of the first passes whose results neighbors may need.
int sharedPasses(const GeneratorGraph& generator);

// Returns a hash of a recorded generator: generators with equal hashes make the same blocks. It covers
// everything that blocks depend on: outputs of passes and the nodes that compute them, noises and names of
// hashes, drainage maps, shapes, fields, and heights other than 0…255. It ignores names of passes, unused
// nodes and the tint. The order in which a pass is recorded does not count: compilers choose different ones.
[[nodiscard]] std::uint64_t graphHash(const GeneratorGraph& generator);

// The seeds of a generator's noise calls and hashes for one world seed. Both back ends use them.
struct Seeds {
    std::vector<std::uint32_t> noises, hashes;  // by noise call, by slot of hashNames
};

std::uint32_t seedOf(const std::string& name, std::uint64_t worldSeed);

// Returns the seeds of a generator. A seed depends on the world's seed and on the name of its call, not on
// its position in the generator.
Seeds makeSeeds(const GeneratorGraph& generator, std::uint64_t worldSeed);
Seeds makeSeeds(const std::vector<NoiseCall>& noises, const std::vector<std::string>& hashNames,
                std::uint64_t worldSeed);

}  // namespace terrane::gen
