#include "terrane/gen/compile/voxel_pass.h"

#include <functional>
#include <string_view>

namespace terrane::gen {

namespace {

ShortPass::Kind kindOf(const PassGraph& pass) {
    const Node& block = pass.graph.node(*pass.block);
    bool dependsOnZ = (block.dependence & kDependsZ) != 0, writesFields = false;
    for (const FieldOutput& f : pass.fields) {
        const Node& value = pass.graph.node(f.value);
        dependsOnZ = dependsOnZ || (value.dependence & kDependsZ) != 0;
        writesFields = writesFields || value.op != Op::Constant || value.imm != 0;
    }
    if (block.op == Op::BlockHere && !writesFields) return ShortPass::Kind::CopyBlocks;
    return dependsOnZ ? ShortPass::Kind::EachLayer : ShortPass::Kind::OneLayer;
}

}  // namespace

ShortPass shortenPass(const SlabPlan& plan, const Decisions& decisions) {
    std::vector<Graph::Known> known;
    for (std::size_t k = 0; k < plan.choices.size(); ++k) {
        if (decisions[k] == Decision::Open) continue;
        known.push_back({plan.choices[k], decisions[k] == Decision::True});
    }
    std::vector<NodeId> standIn;
    PassGraph pass;
    pass.is3D = true;
    pass.graph = plan.pass.graph.withKnown(known, standIn);
    for (const FieldOutput& f : plan.pass.fields) pass.fields.push_back({f.field, standIn[f.value]});
    pass.block = standIn[*plan.pass.block];
    ShortPass result;
    result.kind = kindOf(pass);
    result.program = compileAfter(plan.program, pass, plan.noises, result.constants);
    result.layerInstructions = instructionCount(result.program, result.program.layer);
    return result;
}

std::size_t instructionCount(const Program& program, const InstructionList& list) {
    std::size_t count = list.size();
    for (const Instruction& i : list) {
        if (i.op == Op::Phi) {
            const Branch& b = program.branches[i.imm];
            count += instructionCount(program, b.then) + instructionCount(program, b.otherwise);
        } else if (i.op == Op::LoopOut) {
            const ProgramLoop& l = program.loops[i.imm];
            count += instructionCount(program, l.head) + instructionCount(program, l.body);
        }
    }
    return count;
}

VoxelPass::VoxelPass(const PassGraph& pass, const std::vector<NoiseCall>& noises)
    : program_(compile(pass, noises)),
      plan_(pass, program_, noises),
      layerInstructions_(instructionCount(program_, program_.layer)) {}

const ShortPass* VoxelPass::find(const Decisions& decisions) const {
    const std::string_view bytes(reinterpret_cast<const char*>(decisions.data()), decisions.size());
    std::size_t slot = std::hash<std::string_view>()(bytes) % kSlots;
    while (const Entry* entry = slots_[slot].load(std::memory_order_acquire)) {
        if (entry->decisions == decisions) return &entry->pass;
        slot = (slot + 1) % kSlots;
    }
    if (isFull_.load(std::memory_order_relaxed)) return nullptr;
    return add(decisions, slot);
}

const ShortPass* VoxelPass::add(const Decisions& decisions, std::size_t slot) const {
    const std::lock_guard lock(mutex_);
    // Others may have come first.
    while (const Entry* entry = slots_[slot].load(std::memory_order_relaxed)) {
        if (entry->decisions == decisions) return &entry->pass;
        slot = (slot + 1) % kSlots;
    }
    if (isFull_.load(std::memory_order_relaxed)) return nullptr;
    auto entry = std::make_unique<const Entry>(Entry{decisions, shortenPass(plan_, decisions)});
    const Program& program = entry->pass.program;
    instructions_ += instructionCount(program, program.column) + instructionCount(program, program.layer);
    const bool fits = program.arenaRows <= kMaxArenaRows;
    entries_.push_back(std::move(entry));
    isFull_ = !fits || entries_.size() == kMaxEntries || instructions_ > kMaxInstructions;
    if (!fits) return nullptr;
    slots_[slot].store(entries_.back().get(), std::memory_order_release);
    return &entries_.back()->pass;
}

}  // namespace terrane::gen
