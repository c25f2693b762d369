#include "terrane/net/client/client_world.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "terrane/base/match.h"
#include "terrane/net/wire/client_message.h"
#include "terrane/net/wire/wire.h"
#include "terrane/store/chunks/structure_file.h"

namespace terrane::net {

void Prediction::predict(std::uint32_t number, std::span<const world::PlacedBlock> before) {
    for (const auto& [pos, value] : before)
        ahead_.try_emplace(pos, Ahead{value, 0}).first->second.last = number;
}

std::vector<world::PlacedBlock> Prediction::takeIn(std::span<const world::PlacedBlock> blocks) {
    std::vector<world::PlacedBlock> shown;
    for (const world::PlacedBlock& block : blocks) {
        const auto found = ahead_.find(block.pos);
        if (found == ahead_.end())
            shown.push_back(block);
        else
            found->second.server = block.value;
    }
    return shown;
}

std::vector<world::PlacedBlock> Prediction::settle(std::uint32_t number) {
    std::vector<world::PlacedBlock> settled;
    std::erase_if(ahead_, [&](auto& entry) {
        if (entry.second.last > number) return false;
        settled.push_back({entry.first, std::move(entry.second.server)});
        return true;
    });
    std::ranges::sort(settled, {}, &world::PlacedBlock::pos);  // independent of the hash table's order
    return settled;
}

std::vector<world::PlacedBlock> Prediction::settleAll() {
    return settle(std::numeric_limits<std::uint32_t>::max());
}

namespace {

constexpr std::chrono::milliseconds kMoveEvery{100};

// The view's depth in steps: each of them asks the server for what is in it.
constexpr int kDepthStep = 64;

}  // namespace

ClientWorld::ClientWorld(game::Session& session, RemoteStore& store, Send send)
    : session_(session), store_(store), send_(std::move(send)) {
    session_.setAuthority(
        {[this](const game::EditCommand& command, std::span<const game::ChangedBlock> changed) {
             sendEdit(command, changed);
         },
         [this](const game::BuildCommand& command) { sendBuild(command.change); },
         [this](game::PlayerId, game::HistoryWay way) { sendTakeBack(way); },
         [this](const game::ItemAction& action) { sendAction(action); }});
}

ClientWorld::~ClientWorld() {
    session_.setAuthority({});
}

void ClientWorld::onMessage(const ServerMessage& message) {
    std::visit(base::Match{
                   [this](const Joined& joined) { onJoined(joined); },
                   [this](const ChunkEdits& edits) { onChunkEdits(edits); },
                   [this](const BlocksChanged& changed) { onBlocksChanged(changed); },
                   [this](const Done& done) { onDone(done); }, [this](const Poses& poses) { onPoses(poses); },
                   [this](const Clock& clock) {
                       session_.clock.timeDay = clock.timeDay;
                       session_.clock.isRunning = clock.daysASecond > 0;
                       if (clock.daysASecond > 0) session_.clock.dayMinutes = 1 / (60 * clock.daysASecond);
                   },
                   [this](const Appears& player) {
                       players_[player.slot] = {player.player, player.name, poseOf(player.pose), 1, 0};
                       playerPoses_[player.slot] = player.pose;
                   },
                   [this](const Disappears& player) {
                       players_.erase(player.slot);
                       playerPoses_.erase(player.slot);
                   },
                   [this](const Said& said) {
                       chat_.push_back({said.name, said.text});
                   },
                   [this](const Corrected& corrected) { correction_ = poseOf(corrected.pose); },
                   [this](const ViewComplete& complete) {
                       isViewComplete_ = toldView_ && complete.center == toldView_->center;
                       mayDropUnconfirmed_ = isViewComplete_;
                   },
                   [this](const RoleChanged& changed) {
                       session_.permissions.roles[game::kLocalPlayer] = changed.role;
                   },
                   [this](const PlayerList& list) { playerList_ = list; },
                   [this](const Items& items) { onItems(items); },
                   [](const OfConnection auto&) {},  // ClientLink handles them
               },
               message);
}

void ClientWorld::onCut() {
    isConnected_ = false;
    waiting_.clear();
    show(prediction_.settleAll());
}

void ClientWorld::onJoined(const Joined& joined) {
    onCut();
    maxViewDistance_ = joined.maxViewDistance;
    for (const world::ChunkPos pos : store_.positions()) unconfirmed_.insert(pos);
    isConnected_ = true;
    players_.clear();
    playerPoses_.clear();
    toldPose_.reset();
    toldView_.reset();
    isViewComplete_ = false;
    session_.permissions.roles[game::kLocalPlayer] = joined.role;
    session_.setItems(game::kLocalPlayer, {});  // the first slot is selected on both sides
}

void ClientWorld::onChunkEdits(const ChunkEdits& edits) {
    if (edits.isFirst) unconfirmed_.erase(edits.chunk);
    if (edits.isFirst && edits.chunk.level > 0) return setTile(edits.chunk, edits.blocks);
    if (edits.chunk.level > 0) {
        store_.addDifference(edits.chunk, edits.blocks);
        session_.tiles().tileListener()(std::span(&edits.chunk, 1));
        return;
    }
    if (edits.isFirst) return showChunk(edits.chunk, replaceDifference(edits.chunk, edits.blocks));
    store_.addDifference(edits.chunk, edits.blocks);
    showChunk(edits.chunk, edits.blocks);
}

void ClientWorld::setTile(world::ChunkPos pos, const ChunkDifference& blocks) {
    store_.setDifference(pos, blocks);
    session_.tiles().tileListener()(std::span(&pos, 1));
}

// A ViewComplete names only the center: of several views told before it, it may be about the smallest.
void ClientWorld::noteToldView(const View& view) {
    View least = view;
    if (toldView_ && !isViewComplete_) {
        least.viewDistance = std::min(least.viewDistance, completeView_.viewDistance);
        least.horizon = std::min(least.horizon, completeView_.horizon);
        least.lowest = std::max(least.lowest, completeView_.lowest);
    }
    completeView_ = least;
    toldView_ = view;
    isViewComplete_ = mayDropUnconfirmed_ = false;
}

// The server has told of all edited chunks and tiles in the complete view: the others are as they were
// generated. A few in each frame, since chunks are generated for it.
void ClientWorld::dropUnconfirmed() {
    constexpr std::size_t kDropsAFrame = 16;
    const View view = servedView(completeView_, maxViewDistance_);
    std::size_t dropped = 0;
    for (auto at = unconfirmed_.begin(); at != unconfirmed_.end() && dropped < kDropsAFrame;) {
        const world::ChunkPos pos = *at;
        const bool isSeen = pos.level <= topLevelOf(view) && isInView(view, pos);
        at = isSeen ? unconfirmed_.erase(at) : std::next(at);
        if (!isSeen) continue;
        ++dropped;
        if (pos.level > 0)
            setTile(pos, {});
        else
            showChunk(pos, replaceDifference(pos, {}));
    }
    mayDropUnconfirmed_ = dropped == kDropsAFrame;
}

void ClientWorld::onBlocksChanged(const BlocksChanged& changed) {
    // The server tells of a chunk's first change since it was generated without ChunkEdits.
    if (unconfirmed_.erase(changed.chunk) > 0)
        return showChunk(changed.chunk, replaceDifference(changed.chunk, changed.blocks));
    store_.addDifference(changed.chunk, changed.blocks);
    showChunk(changed.chunk, changed.blocks);
}

// Replaces the known difference of a chunk. Returns the blocks to show: those of `difference`, and blocks
// that no longer differ with their generated value.
ChunkDifference ClientWorld::replaceDifference(world::ChunkPos pos, const ChunkDifference& difference) {
    ChunkDifference former = store_.difference(pos);
    store_.setDifference(pos, difference);
    std::erase_if(former, [&](const ChangedBlock& block) {
        return std::ranges::binary_search(difference, block.index, {}, &ChangedBlock::index);
    });
    if (former.empty()) return difference;
    const world::Chunk generated = session_.generator().generate(pos);
    for (ChangedBlock& block : former) {
        block.value = {generated.block(block.index), generated.blockState(block.index),
                       generated.sharedBlockEntityData(block.index)};
    }
    mergeInto(former, difference);
    return former;
}

// Whether blocks of the chunk cannot be set yet: it is on the way, or not made to its bottom.
bool ClientWorld::isOnTheWay(world::ChunkPos pos) const {
    if (session_.pipeline().stageAt(pos) == stream::ChunkStage::Loading) return true;
    const world::ChunkPtr chunk = session_.world().maybeChunkAt(pos);
    return chunk && !chunk->isMade(chunk->heights().firstSection());
}

void ClientWorld::showChunk(world::ChunkPos pos, const ChunkDifference& blocks) {
    showLateChunks();  // older than `blocks`
    const std::vector<world::PlacedBlock> shown = prediction_.takeIn(placedBlocks(pos, blocks));
    if (isOnTheWay(pos)) {
        mergeInto(late_[pos], blocks);  // the worker may have read the store before this change
        (void)session_.pipeline().maybeLoadChunkAt(pos);
    } else if (session_.world().maybeChunkAt(pos)) {
        show(shown);
    }
}

void ClientWorld::show(std::span<const world::PlacedBlock> blocks) {
    if (!blocks.empty()) session_.setBlocks(blocks);
}

void ClientWorld::showLateChunks() {
    std::erase_if(late_, [this](const auto& entry) {
        const auto& [pos, blocks] = entry;
        if (isOnTheWay(pos)) return false;
        if (session_.world().maybeChunkAt(pos)) show(prediction_.takeIn(placedBlocks(pos, blocks)));
        return true;
    });
}

// Without a connection nothing is sent and the edit is reverted at once.
void ClientWorld::sendEdit(const game::EditCommand& command, std::span<const game::ChangedBlock> changed) {
    std::vector<world::PlacedBlock> before;
    for (const game::ChangedBlock& block : changed) before.push_back({block.pos, block.before});
    if (!isConnected_) return show(before);
    const CommandNumber number = ++lastCommand_;
    prediction_.predict(number, before);
    waiting_.push_back({number, WaitingDecision::Kind::Edit});
    send_(Edit{number, command.pos, command.change, command.expected});
}

void ClientWorld::sendBuild(const game::BuildChange& change) {
    if (!isConnected_)
        return decided_.push_back(game::BuildOutcome{game::BuildOutcome::Result::NotLoaded, 0, 0});
    // The server would refuse it; positions beyond all worlds cannot be sent.
    const world::Heights heights = session_.world().heights();
    const world::BlockBox box = game::boxOf(change);
    if (!heights.contains(box.low.z) || box.high.z < heights.bottom - 1 || box.high.z >= heights.top)
        return decided_.push_back(game::BuildOutcome{game::BuildOutcome::Result::OutOfWorld, 0, 0});
    const CommandNumber number = ++lastCommand_;
    if (const auto* fill = std::get_if<game::FillBox>(&change)) {
        send_(Fill{number, *fill});
    } else {
        const auto& place = std::get<game::PlaceStructure>(change);
        auto bytes = store::encodeStructure(*place.structure);
        if (!bytes || bytes->size() > kMaxStructureWire) {
            decided_.push_back(game::BuildOutcome{game::BuildOutcome::Result::TooLarge, 0, 0});
            return;
        }
        send_(Place{number, place.low, std::move(*bytes)});
    }
    waiting_.push_back({number, WaitingDecision::Kind::Build});
}

void ClientWorld::sendTakeBack(game::HistoryWay way) {
    if (!isConnected_)
        return decided_.push_back(DecidedTakeBack{way, {game::UndoResult::Outcome::NotLoaded, 0, 0}});
    const CommandNumber number = ++lastCommand_;
    const bool isRedo = way == game::HistoryWay::Redo;
    waiting_.push_back({number, isRedo ? WaitingDecision::Kind::Redo : WaitingDecision::Kind::Undo});
    send_(TakeBack{number, isRedo});
}

// Without a connection nothing is sent; the server tells what became of the items.
void ClientWorld::sendAction(const game::ItemAction& action) {
    if (!isConnected_) return;
    const CommandNumber number = ++lastCommand_;
    waiting_.push_back({number, WaitingDecision::Kind::Item});
    send_(ItemCommand{number, action});
}

void ClientWorld::onItems(const Items& items) {
    const std::size_t selected = session_.itemsOf(game::kLocalPlayer).selected;
    session_.setItems(game::kLocalPlayer, {items.mode, items.slots, selected});
}

void ClientWorld::say(const std::string& text) {
    send_(Say{plainText(text, kMaxChatBytes)});
}

void ClientWorld::onDone(const Done& done) {
    show(prediction_.settle(done.number));
    while (!waiting_.empty() && waiting_.front().number < done.number) waiting_.pop_front();
    if (waiting_.empty() || waiting_.front().number != done.number) return;
    using Kind = WaitingDecision::Kind;
    const Kind kind = waiting_.front().kind;
    waiting_.pop_front();
    using Built = game::BuildOutcome::Result;
    using Taken = game::UndoResult::Outcome;
    if (kind == Kind::Build && done.result < static_cast<std::uint8_t>(Built::Sent))
        decided_.push_back(game::BuildOutcome{static_cast<Built>(done.result), done.changed, done.kept});
    if ((kind == Kind::Undo || kind == Kind::Redo) &&
        done.result <= static_cast<std::uint8_t>(Taken::NotAllowed))
        decided_.push_back(
            DecidedTakeBack{kind == Kind::Redo ? game::HistoryWay::Redo : game::HistoryWay::Undo,
                            {static_cast<Taken>(done.result), done.changed, done.kept}});
    const auto result = static_cast<game::EditResult>(done.result);
    const bool isRefused = result != game::EditResult::Applied && result != game::EditResult::Unchanged;
    // The reason of Refused is a line of chat; an item that cannot be moved says nothing.
    const bool isKnown = done.result < static_cast<std::uint8_t>(game::EditResult::Count);
    if (kind == Kind::Edit && isRefused && isKnown && result != game::EditResult::Refused)
        decided_.push_back(result);
}

void ClientWorld::onPoses(const Poses& poses) {
    for (const PoseChange& change : poses.changes) {
        const auto player = players_.find(change.slot);
        if (player == players_.end()) continue;
        WirePose& pose = playerPoses_[change.slot];
        const WirePose moved{.x = pose.x + change.dx, .y = pose.y + change.dy, .z = pose.z + change.dz};
        if (!isInRange(moved)) continue;
        pose = moved;
        pose.yaw = static_cast<std::uint16_t>(change.yaw << 8);
        pose.pitch = static_cast<std::int16_t>(std::max<int>(change.pitch, -127) * kPitchStep);
        player->second.pose = poseOf(pose);
        ++player->second.moves;
        player->second.swings += change.swings;
    }
}

void ClientWorld::update(const world::Pose& pose, int viewDistance, int horizon,
                         std::chrono::steady_clock::time_point now) {
    showLateChunks();
    if (!isConnected_) return;
    if (mayDropUnconfirmed_) dropUnconfirmed();
    session_.setPlayer(game::kLocalPlayer, pose);
    if (now >= nextMove_) {
        const WirePose wire = wirePose(pose);
        if (toldPose_ != wire) send_(Move{wire});
        toldPose_ = wire;
        nextMove_ = now + kMoveEvery;
        lowest_ = std::max(session_.pipeline().lowestNeeded() & ~(kDepthStep - 1), world::kLowestBottom);
    }
    const View view{world::chunkOf(pose.position),
                    static_cast<std::uint8_t>(std::clamp(viewDistance, 0, 255)),
                    static_cast<std::uint16_t>(std::clamp(horizon, 0, 65535)), lowest_};
    if (toldView_ == view) return;
    // Move goes before View: the server accepts a view only near the player.
    if (toldPose_ != wirePose(pose)) send_(Move{*(toldPose_ = wirePose(pose))});
    send_(view);
    noteToldView(view);
}

std::vector<ChatLine> ClientWorld::popChat() {
    return std::exchange(chat_, {});
}
std::vector<Decided> ClientWorld::popDecided() {
    return std::exchange(decided_, {});
}
std::optional<world::Pose> ClientWorld::popCorrection() {
    return std::exchange(correction_, std::nullopt);
}

}  // namespace terrane::net
