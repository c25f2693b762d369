#include "terrane/gen/tint_graph.h"

#include <fmt/format.h>

#include <algorithm>

namespace terrane::gen {
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

std::string cutTint(GeneratorGraph& generator, std::uint32_t field) {
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

}  // namespace terrane::gen
