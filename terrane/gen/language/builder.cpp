#include "terrane/gen/language/builder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "terrane/gen/compile/program.h"
#include "terrane/gen/compile/schedule.h"

namespace terrane::gen {

int branchDepth(const PassGraph& pass) {
    const Schedule whole = schedule(pass.graph, outputsOf(pass), [](NodeId) { return false; });
    int depth = 0;
    for (const BasicBlock& block : whole.basicBlocks) depth = std::max(depth, block.depth);
    return depth;
}

// Arguments stand before their users, and so do all nodes of a loop before its LoopOut nodes.
int branchChain(const PassGraph& pass) {
    const Graph& graph = pass.graph;
    std::vector<int> chain(graph.size(), 0);
    int longest = 0;
    for (NodeId id = 0; id < graph.size(); ++id) {
        const Node& node = graph.node(id);
        int& own = chain[id];
        for (const NodeId argument : node.arguments()) own = std::max(own, chain[argument]);
        if (node.op == Op::Phi) ++own;
        if (node.op == Op::LoopOut) {
            const auto number = static_cast<std::size_t>(graph.loopVariable(node.imm).loop);
            const Loop& loop = graph.loops()[number];
            own = std::max(own, chain[loop.condition]);
            for (const std::uint32_t v : loop.variables)
                own = std::max(own, chain[graph.loopVariable(v).next]);
            own += 2;  // head and body
        }
        longest = std::max(longest, own);
    }
    return longest;
}

std::string branchMistake(const PassGraph& pass) {
    const auto mistake = [&](int depth, int most) {
        return fmt::format(
            "pass \"{}\": its branches nest {} levels deep, at most {} are possible: an if_ whose variable "
            "only one "
            "side of the next if_ reads stands inside that side",
            pass.name, depth, most);
    };
    if (const int chain = branchChain(pass); chain > kMaxBranchChain) return mistake(chain, kMaxBranchChain);
    if (const int depth = branchDepth(pass); depth > kMaxBranchDepth) return mistake(depth, kMaxBranchDepth);
    return "";
}

namespace {

using PassSet = std::vector<bool>;  // by pass

bool readsField(const PassGraph& pass, std::uint32_t field) {
    for (NodeId id = 0; id < pass.graph.size(); ++id) {
        const Node& node = pass.graph.node(id);
        if ((node.op == Op::Field || node.op == Op::FieldAt) && node.imm == field) return true;
    }
    return std::ranges::any_of(
        pass.stamps, [&](const StampCall& call) { return call.shape == field || call.base == field; });
}

bool readsBlocks(const PassGraph& pass) {
    for (NodeId id = 0; id < pass.graph.size(); ++id) {
        const Op op = pass.graph.node(id).op;
        if (op == Op::BlockHere || op == Op::BlockInColumn || op == Op::BlockAt) return true;
    }
    return false;
}

// Adds the passes whose results the passes of the set read.
void addWhatIsRead(const GeneratorGraph& generator, PassSet& set) {
    for (std::size_t pass = set.size(); pass-- > 0;) {
        if (!set[pass]) continue;
        const PassGraph& graph = generator.passes[pass];
        for (std::uint32_t f = 0; f < generator.fields.size(); ++f) {
            const int writer = generator.fields[f].writtenBy;
            if (writer >= 0 && readsField(graph, f)) set[static_cast<std::size_t>(writer)] = true;
        }
        const int before = last3DPassBefore(generator, static_cast<int>(pass));
        if (before >= 0 && (graph.is3D || readsBlocks(graph))) set[static_cast<std::size_t>(before)] = true;
    }
}

// The generator with only the passes of the set, renumbered.
GeneratorGraph withPasses(const GeneratorGraph& generator, const PassSet& set) {
    GeneratorGraph part = generator;
    part.passes.clear();
    for (FieldInfo& field : part.fields) field.writtenBy = -1;
    for (std::size_t pass = 0; pass < set.size(); ++pass) {
        if (!set[pass]) continue;
        for (const FieldOutput& output : generator.passes[pass].fields)
            part.fields[output.field].writtenBy = static_cast<int>(part.passes.size());
        part.passes.push_back(generator.passes[pass]);
    }
    return part;
}

void dropUnreadOutput(GeneratorGraph& generator, std::uint32_t field) {
    const auto reads = [&](const PassGraph& pass) { return readsField(pass, field); };
    if (std::ranges::any_of(generator.passes, reads)) return;
    for (PassGraph& pass : generator.passes)
        std::erase_if(pass.fields, [&](const FieldOutput& output) { return output.field == field; });
    generator.fields[field].writtenBy = -1;
}

}  // namespace

std::string extractTint(GeneratorGraph& generator, std::uint32_t field) {
    const FieldInfo& info = generator.fields[field];
    if (info.writtenBy < 0) return fmt::format("tint: no pass writes field \"{}\"", info.name);
    PassSet forTint(generator.passes.size());
    forTint[static_cast<std::size_t>(info.writtenBy)] = true;
    addWhatIsRead(generator, forTint);
    for (std::size_t pass = 0; pass < forTint.size(); ++pass) {
        if (!forTint[pass] || !generator.passes[pass].is3D) continue;
        return fmt::format("tint: field \"{}\" needs the 3D pass \"{}\": 2D passes alone make a tint",
                           info.name, generator.passes[pass].name);
    }
    const auto tint = std::make_shared<TintGraph>(TintGraph{withPasses(generator, forTint), field});
    for (PassGraph& pass : tint->passes.passes) {
        std::erase_if(pass.fields, [&](const FieldOutput& output) {
            const auto reads = [&](const PassGraph& other) { return readsField(other, output.field); };
            return output.field != field && std::ranges::none_of(tint->passes.passes, reads);
        });
    }
    PassSet forBlocks(generator.passes.size());
    for (std::size_t pass = 0; pass < forBlocks.size(); ++pass) forBlocks[pass] = generator.passes[pass].is3D;
    addWhatIsRead(generator, forBlocks);
    generator = withPasses(generator, forBlocks);
    dropUnreadOutput(generator, field);
    generator.tint = tint;
    return "";
}

GeneratorBuilder::GeneratorBuilder(std::string name, const world::BlockRegistry& blocks, GraphRequest request)
    : requestedHeights_(request.heights), blocks_(blocks) {
    generator_.name = std::move(name);
    if (request.level < 0 || request.level > world::kMaxLevel) {
        errors_.push_back(fmt::format("level {} is not in 0…{}", request.level, world::kMaxLevel));
        request.level = 0;
    }
    generator_.level = request.level;
    setHeights(requestedHeights_.over({}));
}

void GeneratorBuilder::setHeights(world::Heights heights) {
    const auto valid = world::checkHeights(heights);
    heightsMistake_ = valid ? "" : valid.error().message;
    if (valid) generator_.heights = heights;
}

void GeneratorBuilder::declareHeights(world::Heights heights) {
    if (!written_.empty()) errors_.push_back("heights are declared after a pass");
    if (declaresHeights_) errors_.push_back("heights are declared twice");
    declaresHeights_ = true;
    // A mistake in a declaration is one whatever the world is.
    if (const auto valid = world::checkHeights(heights); !valid)
        errors_.push_back(valid.error().message);
    else
        setHeights(requestedHeights_.over(heights));
}

int GeneratorBuilder::last3DPass() const {
    for (std::size_t k = generator_.passes.size(); k-- > 0;) {
        if (generator_.passes[k].is3D) return static_cast<int>(k);
    }
    return -1;
}

std::uint32_t GeneratorBuilder::newField(std::string_view name, Type type) {
    const auto sameName = [&](const FieldInfo& info) { return info.name == name; };
    if (std::any_of(generator_.fields.begin(), generator_.fields.end(), sameName)) {
        errors_.push_back(fmt::format("field \"{}\" is declared twice", name));
    }
    generator_.fields.push_back({std::string(name), type});
    return static_cast<std::uint32_t>(generator_.fields.size() - 1);
}

void GeneratorBuilder::setTint(std::uint32_t field, Type type) {
    if (tint_) errors_.push_back("tint is given twice");
    if (field >= generator_.fields.size()) {
        errors_.push_back("tint: this generator has no such field");
        return;
    }
    if (type != Type::Int) {
        errors_.push_back(fmt::format("tint: field \"{}\" holds no packed colors, which are Int",
                                      generator_.fields[field].name));
    }
    tint_ = field;
}

void GeneratorBuilder::addPass(std::string name, bool is3D, const std::function<void(Pass&)>& body) {
    const int number = static_cast<int>(generator_.passes.size());
    Pass& pass = *written_.emplace_back(new Pass(*this, number, std::move(name), is3D));
    body(pass);
    generator_.passes.push_back(pass.finish());
}

namespace {

bool hasCells(NoiseKind kind) {
    return kind == NoiseKind::Voronoi2D || kind == NoiseKind::Voronoi3D;
}

std::string octaveMistake(const NoiseCall& call) {
    const auto& weights = call.weights;
    if (weights.empty() || weights.size() > 12) return "takes 1 to 12 octave weights";
    if (std::all_of(weights.begin(), weights.end(), [](float w) { return w == 0.0f; })) {
        return "all octave weights are 0";
    }
    const bool isTooLarge = (std::int64_t{call.size} << (weights.size() - 1)) > (1 << 20);
    return isTooLarge ? "the largest octave is beyond 2^20 blocks" : "";
}

std::string cellMistake(const NoiseCall& call) {
    if (call.size > kMaxVoronoiSize) return fmt::format("cells are at most {} blocks", kMaxVoronoiSize);
    if (call.maxPoints < 1 || call.maxPoints > 4) {
        return fmt::format("{} points per cell, expected 1 to 4", call.maxPoints);
    }
    if (call.exponent < 2 || call.exponent > 8) {
        return fmt::format("metric exponent {}, expected 2 to 8", call.exponent);
    }
    return "";
}

std::string noiseMistake(const NoiseCall& call) {
    if (call.size < 1 || call.size > 65536) return fmt::format("size {} is not in 1…65536", call.size);
    if (call.kind == NoiseKind::Stripes2D) return "";
    return hasCells(call.kind) ? cellMistake(call) : octaveMistake(call);
}

}  // namespace

NoiseCall GeneratorBuilder::checkedNoise(Pass& pass, std::string_view kind, NoiseCall call) {
    const std::string mistake = noiseMistake(call);
    if (!mistake.empty()) {
        pass.error(fmt::format("noise \"{}\": {}", call.name, mistake));
        call.size = 16;
        call.weights = {1.0f};
        call.maxPoints = 1;
        call.exponent = 2;
    }
    const std::string parameters = fmt::format("{} {} {} {} {}", kind, call.size,
                                               fmt::join(call.weights, " "), call.maxPoints, call.exponent);
    const auto [known, isNew] = noiseParameters_.emplace(call.name, parameters);
    if (!isNew && known->second != parameters) {
        pass.error(fmt::format("noise \"{}\" is used twice with different parameters", call.name));
    }
    call.weights = fadedWeights(std::move(call.weights), call.size, step());
    return call;
}

std::uint32_t GeneratorBuilder::noiseIndex(const NoiseCall& call) {
    auto& noises = generator_.noises;
    const auto known = std::find(noises.begin(), noises.end(), call);
    if (known != noises.end()) return static_cast<std::uint32_t>(known - noises.begin());
    noises.push_back(call);
    return static_cast<std::uint32_t>(noises.size() - 1);
}

std::uint32_t GeneratorBuilder::hashSlot(const std::string& seedName) {
    auto& names = generator_.hashNames;
    const auto known = std::find(names.begin(), names.end(), seedName);
    if (known != names.end()) return static_cast<std::uint32_t>(known - names.begin());
    names.push_back(seedName);
    return static_cast<std::uint32_t>(names.size() - 1);
}

// Compiles only what has no other mistakes: a graph that has some may not make sense.
void GeneratorBuilder::checkRegisters() {
    const auto check = [this](const PassGraph& pass, const std::vector<NoiseCall>& noises) {
        const std::uint32_t rows = compile(pass, noises).arenaRows;
        if (rows <= kMaxArenaRows) return;
        errors_.push_back(
            fmt::format("pass \"{}\": its values need {} rows of registers, at most {} are possible: split "
                        "it into several passes",
                        pass.name, rows, kMaxArenaRows));
    };
    for (const PassGraph& pass : generator_.passes) check(pass, generator_.noises);
    for (const DrainageGraph& map : generator_.drainages) check(map.heights, map.noises);
}

// Before anything that calls itself for each level of branches.
void GeneratorBuilder::checkBranches(const GeneratorGraph& generator) {
    const auto check = [this](const PassGraph& pass) {
        if (std::string mistake = branchMistake(pass); !mistake.empty())
            errors_.push_back(std::move(mistake));
    };
    for (const PassGraph& pass : generator.passes) check(pass);
    for (const DrainageGraph& map : generator.drainages) check(map.heights);
}

base::Result<GeneratorGraph> GeneratorBuilder::finish() {
    if (!heightsMistake_.empty()) errors_.push_back(heightsMistake_);
    if (generator_.passes.empty() || !generator_.passes.back().is3D) {
        errors_.push_back("the last pass must be a 3D pass");
    } else {
        const PassGraph& last = generator_.passes.back();
        for (const FieldOutput& f : last.fields) {
            errors_.push_back(fmt::format("pass \"{}\": field \"{}\": no later pass could read it", last.name,
                                          generator_.fields[f.field].name));
        }
    }
    if (errors_.empty()) checkBranches(generator_);
    if (errors_.empty()) checkRegisters();
    if (errors_.empty() && tint_) {
        if (const std::string mistake = extractTint(generator_, *tint_); !mistake.empty())
            errors_.push_back(mistake);
        // Without the outputs that it cuts out, nodes stand deeper.
        if (errors_.empty()) checkBranches(generator_);
        if (errors_.empty()) checkBranches(generator_.tint->passes);
    }
    if (errors_.empty()) makeShapeTable();
    if (!errors_.empty()) {
        return base::fail("generator \"{}\": {}", generator_.name, fmt::join(errors_, "; "));
    }
    return std::move(generator_);
}

}  // namespace terrane::gen
