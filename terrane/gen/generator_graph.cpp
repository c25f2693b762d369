#include "terrane/gen/generator_graph.h"

#include <algorithm>

namespace terrane::gen {

std::vector<NodeId> outputsOf(const PassGraph& pass) {
    std::vector<NodeId> outputs;
    for (const FieldOutput& f : pass.fields) {
        outputs.push_back(f.value);
        if (f.isWritten) outputs.push_back(*f.isWritten);
    }
    if (pass.block) outputs.push_back(*pass.block);
    return outputs;
}

int last3DPassBefore(const GeneratorGraph& generator, int pass) {
    while (--pass >= 0 && !generator.passes[static_cast<std::size_t>(pass)].is3D) {
    }
    return pass;
}

int passesNeededAround(const GeneratorGraph& generator, int pass) {
    const PassGraph& graph = generator.passes[static_cast<std::size_t>(pass)];
    int needed = graph.readsBlocksAt ? last3DPassBefore(generator, pass) + 1 : 0;
    for (const std::uint32_t f : graph.readsAt) needed = std::max(needed, generator.fields[f].writtenBy + 1);
    return needed;
}

int sharedPasses(const GeneratorGraph& generator) {
    int shared = 0;
    for (int pass = 0; pass < static_cast<int>(generator.passes.size()); ++pass) {
        shared = std::max(shared, passesNeededAround(generator, pass));
    }
    return shared;
}

}  // namespace terrane::gen
