#include "terrane/gen/voxel_pass.h"

#include <functional>
#include <string_view>

namespace terrane::gen {

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
