#include "terrane/game/session.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>
#include <map>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/game/items.h"
#include "terrane/stream/edited_tiles.h"
#include "terrane/world/blocks/sign.h"
#include "terrane/world/changes/random_ticks.h"

namespace terrane::game {
namespace {

// The middle of a block and its corners are 0.87 blocks apart.
constexpr double kBlockRadius = 1;
// Limits the ticks after a stall.
constexpr double kMaxTickSeconds = 1;

// Whether the area has columns of the chunk or of those beside it.
bool touches(const ColumnArea& area, world::ChunkPos pos) {
    return pos.x >= (area.x0 >> 4) - 1 && pos.x <= (area.x1 >> 4) + 1 && pos.y >= (area.y0 >> 4) - 1 &&
           pos.y <= (area.y1 >> 4) + 1;
}

// The smallest box with all of the blocks.
world::BlockBox boxAround(std::span<const world::PlacedBlock> blocks) {
    if (blocks.empty()) return {};
    world::BlockBox box{blocks.front().pos, blocks.front().pos};
    for (const world::PlacedBlock& block : blocks) {
        box.low = {std::min(box.low.x, block.pos.x), std::min(box.low.y, block.pos.y),
                   std::min(box.low.z, block.pos.z)};
        box.high = {std::max(box.high.x, block.pos.x), std::max(box.high.y, block.pos.y),
                    std::max(box.high.z, block.pos.z)};
    }
    return box;
}

}  // namespace

// Loading is about ten times as fast as generating (docs/performance.md): persistent stores keep generated
// chunks too.
Session::Session(SessionParts parts)
    : blocks_(std::move(parts.blocks)),
      farBlocks_(blocks_->forFarTiles()),
      lights_(*blocks_),
      generators_(std::move(parts.generators)),
      generator_(*generators_.at(0).value()),
      store_(std::move(parts.store)),
      world_(generator_.heights()),
      jobs_(parts.threads),
      pipeline_({jobs_,
                 *blocks_,
                 lights_,
                 world_,
                 {&generator_, store_.get(), parts.storesGenerated && store_->isPersistent()},
                 parts.batchGenerator,
                 parts.batchLighter,
                 parts.meshing}),
      tiles_({jobs_, farBlocks_, generators_, store_.get()}) {
    const auto tell = [own = tiles_.tileListener(),
                       other = std::move(parts.tileListener)](std::span<const world::ChunkPos> tiles) {
        own(tiles);
        if (other) other(tiles);
    };
    stream::maintainTileRows(*store_, generators_, *blocks_, tell);
    if (store_->isPersistent()) buildTiles();
}

void Session::buildTiles() {
    const auto built = stream::buildTileRows(*store_);
    if (!built) base::logError("distant land is shown without edits: {}", built.error().message);
}

EditResult Session::edit(const EditCommand& command) {
    // Chests change by act(), so that no item comes from nowhere.
    if (isSurvival(command) && std::holds_alternative<world::SetEntityData>(command.change) &&
        isContainer(world_, *blocks_, command.pos))
        return EditResult::Creative;
    if (authority_.edited && command.player != kNoPlayer) return predictEdit(command);
    return applyAll(std::span(&command, 1)).front();
}

std::vector<EditResult> Session::edit(std::span<const EditCommand> commands) {
    const auto isInSurvival = [this](const EditCommand& command) { return isSurvival(command); };
    if (!authority_.edited && std::ranges::none_of(commands, isInSurvival)) return applyAll(commands);
    std::vector<EditResult> results;  // the authority, and survival, decide on one command at a time
    for (const EditCommand& command : commands) results.push_back(edit(command));
    return results;
}

// Applies a command before the authority decides on it. The authority keeps the player's steps.
EditResult Session::predictEdit(const EditCommand& command) {
    std::vector<world::BlockEdit> edits;
    PlayerChanges changes;
    const EditResult result = apply(command, edits, changes);
    if (result != EditResult::Applied) return result;
    EditStep changed = stepSince(world_, changes.steps);
    std::ranges::move(stepSince(world_, changes.uses), std::back_inserter(changed));
    notifyEdits({command.player}, edits);
    authority_.edited(command, changed);
    return result;
}

std::vector<EditResult> Session::applyAll(std::span<const EditCommand> commands) {
    std::vector<EditResult> results;
    std::vector<world::BlockEdit> edits;
    std::map<Author, PlayerChanges> changes;
    std::vector<BlockAction> actions;
    auto held = together ? together() : nullptr;
    results.reserve(commands.size());
    for (const EditCommand& command : commands) {
        const auto action = actionOf(command);
        results.push_back(apply(command, edits, changes[{command.player, command.pack}]));
        if (action && results.back() == EditResult::Applied) actions.push_back(*action);
    }
    for (auto& [author, changed] : changes) {
        const auto found = players_.find(author.player);
        const bool isPlayers = author.pack == kNoPack && author.player != kNoPlayer;
        if (isPlayers && found == players_.end()) continue;
        EditStep step = notifyStep(author, changed.steps);
        if (!isPlayers) continue;
        notifyStep(author, changed.uses);
        found->second.history.add(std::move(step));
    }
    const EditCommand first = commands.empty() ? EditCommand{} : commands.front();
    notifyEdits({first.player, first.pack}, edits);
    for (const PlayerId player : std::exchange(paid_, {})) notifyItems(player);
    held.reset();
    for (BlockAction& action : actions) events.block.notify(action);
    return results;
}

// What a player does with a command; nothing if it is another's, or changes the data of a block.
std::optional<BlockAction> Session::actionOf(const EditCommand& command) const {
    if (command.player == kNoPlayer || command.pack != kNoPack) return std::nullopt;
    const world::BlockId there = world_.block(command.pos);
    if (std::holds_alternative<world::UseBlock>(command.change))
        return BlockAction{BlockAct::Use, command.player, command.pos, there, there};
    const auto* set = std::get_if<world::SetBlock>(&command.change);
    if (!set) return std::nullopt;
    const BlockAct act = set->id == world::kAir ? BlockAct::Break : BlockAct::Place;
    return BlockAction{act, command.player, command.pos, there, set->id};
}

bool Session::isRefused(const BlockAction& action) {
    BeforeBlockAction before{action, {}};
    events.beforeBlock.notify(before);
    if (before.refusal) events.said.notify({action.player, *before.refusal});
    return before.refusal.has_value();
}

bool Session::isRefused(const BuildAction& action) {
    BeforeBuildAction before{action, {}};
    events.beforeBuild.notify(before);
    if (before.refusal) events.said.notify({action.player, *before.refusal});
    return before.refusal.has_value();
}

EditResult Session::apply(const EditCommand& command, std::vector<world::BlockEdit>& edits,
                          PlayerChanges& changes) {
    const bool isPacks = command.pack != kNoPack;
    if (!isPacks && !canReach(command.player, command.pos)) return EditResult::OutOfReach;
    if (!world_.isMade(command.pos)) return EditResult::NotLoaded;
    if (const auto refused = refusal(permissions, command.player, command.pos)) return *refused;
    if (command.expected && *command.expected != world_.block(command.pos)) return EditResult::Conflict;
    if (!isPacks)
        if (const auto refusal = refusalOfBreaking(command)) return *refusal;
    const auto* data = std::get_if<world::SetEntityData>(&command.change);
    const bool isText = data && world::isSign(blocks_->type(world_.block(command.pos)));
    if (isText && !world::decodeSign(data->data)) return EditResult::BadData;
    if (data && !maySetItems(world_, *blocks_, command.pos, data->data)) return EditResult::BadData;
    if (const auto refused = refusalOfSurvival(command)) return *refused;
    if (const auto action = actionOf(command); action && isRefused(*action)) return EditResult::Refused;
    const world::BlockId there = world_.block(command.pos);
    const std::size_t before = edits.size();
    const bool isStep = isText || std::holds_alternative<world::SetBlock>(command.change);
    // Changes by nobody are one step, recorded only for a history: of scripts if it hears all, of packs, and
    // growth.
    const bool isGrowth = std::holds_alternative<world::RunTick>(command.change);
    const bool isRecorded = command.player != kNoPlayer || !events.changedAtAll.isEmpty() ||
                            ((isGrowth || isPacks) && hasHistory());
    const bool isOneStep = isStep || isPacks || command.player == kNoPlayer;
    world::BlockRecorder& recorded = isOneStep ? changes.steps : changes.uses;
    const bool mayBeRefused = command.player != kNoPlayer && !permissions.claims.all().empty();
    world::BlockRecorder own;  // of a change that may have to be taken back
    world::BlockRecorder* const recorder = mayBeRefused ? &own : &recorded;
    world::applyChange(world_, *blocks_, command.pos, command.change, edits, isRecorded ? recorder : nullptr);
    if (!mayBeRefused) {
        if (edits.size() == before) return EditResult::Unchanged;
        settle(command, there);
        return EditResult::Applied;
    }
    std::vector<world::PlacedBlock> former = own.take();
    if (breaksForeign(command.player, std::span(edits).subspan(before))) {
        takeBackAll(former, edits, before);
        return EditResult::Claimed;
    }
    for (world::PlacedBlock& block : former) recorded.note(block.pos, std::move(block.value));
    if (edits.size() == before) return EditResult::Unchanged;
    settle(command, there);
    return EditResult::Applied;
}

// Whether a consequence of a player's change replaces a block that the player may not change, such as a torch
// on the other side of a claim's border. States may change: a fence gets an arm.
bool Session::breaksForeign(PlayerId player, std::span<const world::BlockEdit> edits) const {
    if (permissions.claims.all().empty()) return false;
    return std::ranges::any_of(edits, [&](const world::BlockEdit& edit) {
        return edit.before != edit.after && refusal(permissions, player, edit.pos);
    });
}

UndoResult Session::undoOrRedo(PlayerId player, HistoryWay way) {
    using Outcome = UndoResult::Outcome;
    if (modeOf(player) != Mode::Creative) return {Outcome::NotAllowed};
    if (authority_.undoOrRedo) {
        authority_.undoOrRedo(player, way);
        return {Outcome::Sent};
    }
    const auto found = players_.find(player);
    const EditStep* step = found == players_.end() ? nullptr : found->second.history.next(way);
    if (!step) return {Outcome::NoStep};
    if (!std::ranges::all_of(*step, [&](const ChangedBlock& block) { return world_.isMade(block.pos); }))
        return {Outcome::NotLoaded};
    // The step is dropped, so that the ones before it can be undone.
    const auto refuse = [&]() -> UndoResult {
        found->second.history.finishStep(way, {});
        return {Outcome::NotAllowed};
    };
    if (!mayChangeAll(permissions, player, *step)) return refuse();
    const std::vector<world::PlacedBlock> blocks = blocksBefore(world_, *step);
    const UndoResult result{Outcome::Done, blocks.size(), step->size() - blocks.size()};
    const BuildAction action{way == HistoryWay::Undo ? BuildAct::Undo : BuildAct::Redo, player,
                             boxAround(blocks), blocks.size()};
    if (isRefused(action)) {
        found->second.history.finishStep(way, {});
        return {Outcome::Refused};
    }
    std::vector<world::BlockEdit> edits;
    world::BlockRecorder recorder;
    world::restoreBlocks(world_, *blocks_, blocks, edits, &recorder);
    if (breaksForeign(player, edits)) {
        takeBackAll(recorder.take(), edits, 0);
        return refuse();
    }
    EditStep reverse = notifyStep({player}, recorder);
    found->second.history.finishStep(way, std::move(reverse));
    notifyEdits({player}, edits);
    events.build.notify(BuildAction(action));
    return result;
}

std::vector<world::ChunkPos> Session::chunksOfNextStep(PlayerId player, HistoryWay way) const {
    const auto found = players_.find(player);
    const EditStep* step = found == players_.end() ? nullptr : found->second.history.next(way);
    std::vector<world::ChunkPos> chunks;
    if (!step) return chunks;
    // The blocks of a step are ordered by chunk.
    for (const ChangedBlock& block : *step)
        if (chunks.empty() || chunks.back() != world::chunkOf(block.pos))
            chunks.push_back(world::chunkOf(block.pos));
    return chunks;
}

std::optional<EditResult> Session::refusalOfBreaking(const EditCommand& command) const {
    const world::BlockId there = world_.block(command.pos);
    const bool isPlayers = command.player != kNoPlayer;
    if (!isPlayers || there == world::kAir || !std::holds_alternative<world::SetBlock>(command.change))
        return std::nullopt;
    if (command.pos.z == world_.heights().bottom) return EditResult::Protected;
    const auto* holder = world::behaviorWith(blocks_->type(there), &world::BlockBehavior::items);
    if (!holder) return std::nullopt;
    const auto items = holder->items(world_, *blocks_, command.pos);
    const bool isEmpty =
        items && std::ranges::all_of(*items, [](const world::ItemStack& s) { return s.count == 0; });
    return isEmpty ? std::nullopt : std::optional(EditResult::NotEmpty);
}

// Takes back a change that is refused, before anyone hears of it.
void Session::takeBackAll(std::span<const world::PlacedBlock> former, std::vector<world::BlockEdit>& edits,
                          std::size_t firstEdit) {
    std::vector<world::BlockEdit> ignored;
    world::BlockUpdate(world_, *blocks_, ignored).restore(former, world::RestoreScope::None);
    edits.resize(firstEdit);
}

void Session::notifyEdits(Author author, std::span<const world::BlockEdit> edits) {
    if (hasHistory() && author != Author{}) flow_.note(world_, *blocks_, edits, numberOf(author));
    pipeline_.onEdits(edits);
    if (!edits.empty()) events.edited.notify({author.player, edits});
}

// Tells recorded changes; returns those that the player can undo.
EditStep Session::notifyStep(Author author, world::BlockRecorder& recorder) {
    EditStep all = allSince(world_, recorder);
    if (!all.empty()) events.changedAtAll.notify({author, all});
    EditStep step = stepOf(std::move(all));
    if (!step.empty()) events.changed.notify({author, step});
    return step;
}

void Session::setBlocks(std::span<const world::PlacedBlock> blocks) {
    std::vector<world::BlockEdit> edits;
    world::BlockUpdate update(world_, *blocks_, edits);
    update.restore(blocks, world::RestoreScope::None);
    notifyEdits({}, edits);
}

void Session::runRules(std::span<const world::BlockPos> positions) {
    std::vector<world::PlacedBlock> blocks;
    for (const world::BlockPos pos : positions)
        if (world_.isMade(pos)) blocks.push_back({pos, world::blockValue(world_, pos)});
    std::vector<world::BlockEdit> edits;
    world::BlockRecorder recorder;
    world::restoreBlocks(world_, *blocks_, blocks, edits, &recorder);
    notifyStep({}, recorder);
    notifyEdits({}, edits);
}

bool Session::canReach(PlayerId player, world::BlockPos pos) const {
    if (player == kNoPlayer) return true;
    const auto found = players_.find(player);
    if (found == players_.end()) return false;
    const glm::dvec3 middle(pos.x + 0.5, pos.y + 0.5, pos.z + 0.5);
    return glm::distance(middle, found->second.pose.position) <= kReach + kBlockRadius;
}

void Session::advance(double seconds, world::ChunkPos center) {
    advance(seconds, world::chunksWithin(center, world::kTickRadius));
}

void Session::advance(double seconds, std::span<const world::ChunkPos> chunks) {
    clock.advance(seconds);
    seconds_ += seconds;
    if (authority_.edited) return;
    const double tickSeconds = std::chrono::duration<double>(world::kTickLength).count();
    untilTick_ += std::min(seconds, kMaxTickSeconds);
    for (; untilTick_ >= tickSeconds; untilTick_ -= tickSeconds) {
        std::vector<EditCommand> ticks;
        const std::uint64_t tick = ticks_++;
        for (const world::BlockPos pos : world::blocksToTick(world_, *blocks_, tick, chunks))
            ticks.push_back({kNoPlayer, pos, world::RunTick{}, std::nullopt});
        edit(ticks);
        if (ticks_ % world::kTicksPerFlow == 0) flow(chunks);
        if (!events.randomTickBlocks.empty())
            for (const world::BlockPos pos :
                 world::blocksOfKinds(world_, events.randomTickBlocks, tick, chunks))
                events.randomTick.notify({pos, world_.block(pos)});
        events.tick.notify({tick});
    }
}

// Liquid does not flow into a claim from outside, and changes nothing in it from there: it would wash away
// what others may not break.
void Session::flow(std::span<const world::ChunkPos> chunks) {
    // A thousand cells ask for their neighbors: only the claims near them are searched.
    std::vector<const Claim*> near;
    for (const Claim& claim : permissions.claims.all())
        if (std::ranges::any_of(chunks, [&](world::ChunkPos pos) { return touches(claim.area, pos); }))
            near.push_back(&claim);
    const auto claimAt = [&](world::BlockPos pos) {
        const auto found =
            std::ranges::find_if(near, [&](const Claim* claim) { return claim->area.contains(pos); });
        return found == near.end() ? nullptr : *found;
    };
    const world::MayReach mayReach = [&](world::BlockPos from, world::BlockPos to) {
        const Claim* claim = claimAt(to);
        return !claim || claim == claimAt(from);
    };
    std::vector<world::BlockEdit> edits;
    world::flowLiquids(world_, *blocks_, chunks, edits,
                       {near.empty() ? nullptr : &mayReach, hasHistory() ? &flow_ : nullptr});
    for (auto& [cause, changes] : flow_.changes) notifyStep(authorOf(cause), changes);
    flow_.changes.clear();
    notifyEdits({}, edits);
}

std::optional<world::Pose> Session::poseOf(PlayerId player) const {
    const auto found = players_.find(player);
    return found == players_.end() ? std::nullopt : std::optional(found->second.pose);
}

void Session::queueSaves() {
    const auto held = store_->together();
    pipeline_.saveAll();
    events.saving.notify({});
}

base::Result<void> Session::save() {
    queueSaves();
    return store_->flush();
}

std::vector<stream::TaskTime> Session::taskTimes() const {
    std::vector<stream::TaskTime> times = pipeline_.taskTimes();
    times.push_back(tiles_.taskTime());
    return times;
}

const world::BlockType* solidBlockAt(const Session& session, const glm::dvec3& point, double margin) {
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const world::BlockPos pos = world::blockOf(point + margin * side);
        const world::BlockValue value = world::blockValue(session.world(), pos);
        const world::BlockType& type = session.blocks().type(value.id);
        const glm::dvec3 inBlock = point - glm::dvec3(pos.x, pos.y, pos.z);
        for (const world::Box& box : world::collisionBoxes(type, value.state)) {
            const glm::dvec3 min = glm::dvec3(box.min) - margin, max = glm::dvec3(box.max) + margin;
            if (glm::all(glm::lessThanEqual(min, inBlock)) && glm::all(glm::lessThan(inBlock, max)))
                return &type;
        }
    }
    return nullptr;
}

bool isUnderWater(const Session& session, const glm::dvec3& point) {
    const world::BlockId water = session.blocks().find("water")->id;
    const world::BlockPos pos = world::blockOf(point);
    if (session.world().block(pos) != water) return false;
    return point.z - pos.z < world::liquidHeight(session.world(), session.blocks(), pos);
}

int waterAbove(const Session& session, const glm::dvec3& point) {
    if (!isUnderWater(session, point)) return 0;
    const world::BlockId water = session.blocks().find("water")->id;
    const world::BlockPos at = world::blockOf(point);
    constexpr int kMost = 64;
    int blocks = 1;
    while (blocks < kMost && session.world().block({at.x, at.y, at.z + blocks}) == water) ++blocks;
    return blocks;
}

}  // namespace terrane::game
