#include "terrane/game/edit_history.h"

#include <utility>

#include "terrane/world/changes/liquid_flow.h"

namespace terrane::game {
namespace {

bool isSameData(const world::BlockValue& a, const world::BlockValue& b) {
    if (!a.data || !b.data) return !a.data && !b.data;
    return a.data == b.data || *a.data == *b.data;
}

// Liquid beside a change becomes unsettled: that is no change to undo.
bool isUnchanged(const world::BlockValue& before, const world::BlockValue& now) {
    const bool isSameLiquid = before.id == now.id && !before.data && !now.data;
    return now == before || (isSameLiquid && (before.state | world::kUnsettled) == now.state);
}

}  // namespace

EditStep allSince(const world::World& world, world::BlockRecorder& recorder) {
    EditStep changes;
    for (world::PlacedBlock& noted : recorder.take()) {
        world::BlockValue now = world::blockValue(world, noted.pos);
        if (now != noted.value) changes.push_back({noted.pos, std::move(noted.value), std::move(now)});
    }
    return changes;
}

EditStep stepOf(EditStep changes) {
    std::erase_if(changes, [](const ChangedBlock& block) { return isUnchanged(block.before, block.after); });
    return changes;
}

EditStep stepSince(const world::World& world, world::BlockRecorder& recorder) {
    return stepOf(allSince(world, recorder));
}

std::vector<world::PlacedBlock> blocksBefore(const world::World& world, const EditStep& step) {
    std::vector<world::PlacedBlock> blocks;
    blocks.reserve(step.size());
    for (const ChangedBlock& block : step) {
        const world::BlockValue now = world::blockValue(world, block.pos);
        if (now.id == block.after.id && isSameData(now, block.after))
            blocks.push_back({block.pos, block.before});
    }
    return blocks;
}

void EditHistory::push(Steps& to, EditStep step) {
    if (step.empty()) return;
    to.blocks += step.size();
    to.steps.push_back(std::move(step));
    while (to.steps.size() > 1 && (to.steps.size() > kMaxSteps || to.blocks > kMaxBlocks)) {
        to.blocks -= to.steps.front().size();
        to.steps.pop_front();
    }
}

void EditHistory::add(EditStep step) {
    if (step.empty()) return;
    redo_ = {};
    push(undo_, std::move(step));
}

const EditStep* EditHistory::next(HistoryWay way) const {
    const std::deque<EditStep>& steps = of(way).steps;
    return steps.empty() ? nullptr : &steps.back();
}

void EditHistory::finishStep(HistoryWay way, EditStep reverse) {
    Steps& from = of(way);
    from.blocks -= from.steps.back().size();
    from.steps.pop_back();
    push(of(way == HistoryWay::Undo ? HistoryWay::Redo : HistoryWay::Undo), std::move(reverse));
}

}  // namespace terrane::game
