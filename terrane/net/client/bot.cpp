#include "terrane/net/client/bot.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "terrane/base/match.h"
#include "terrane/net/client/remote_session.h"
#include "terrane/world/character.h"

namespace terrane::net {

base::Result<SampleDigests> BotLand::prove(const WorldOffer& offer) {
    if (generator_ && offer.world == offer_.world && offer.samples == offer_.samples &&
        offer.packs == offer_.packs)
        return digests_;
    auto content = TERRANE_TRY(contentOf(packs, offer));
    content_ = std::move(content);
    auto generator = TERRANE_TRY(offeredGenerator(offer, *content_.blocks, content_.generators));
    generator_ = std::make_unique<gen::Generator>(std::move(generator));
    offer_ = offer;
    digests_ = sampleDigests(*generator_, offer.samples);
    ground_.clear();
    return digests_;
}

int BotLand::groundHeight(std::int32_t x, std::int32_t y) {
    const world::BlockPos pos{x, y, 0};
    const auto [found, isNew] = ground_.try_emplace(world::chunkOf(pos));
    if (isNew) {
        const world::Chunk chunk = generator_->generate(world::chunkOf(pos));
        for (int column = 0; column < world::kBlocksPerLayer; ++column) {
            int z = heights().top - 1;
            while (z > heights().bottom && chunk.block(column + world::kBlocksPerLayer * z) == world::kAir)
                --z;
            found->second[static_cast<std::size_t>(column)] = static_cast<std::int16_t>(z);
        }
    }
    return found->second[static_cast<std::size_t>(world::blockIndex(pos))];
}

namespace {

constexpr double kWalkSpeed = 4.3;
constexpr double kRoam = 48, kCrowdRoam = 10;
constexpr std::chrono::milliseconds kBotMovesEvery{100};

std::string botName(const BotSettings& settings, int number) {
    return fmt::format("{}{}", settings.name, number);
}

ClientIdentity identityOf(const BotSettings& settings, int number, const PlayerKey& key) {
    ClientIdentity identity;
    identity.name = botName(settings, number);
    identity.password = settings.password;
    identity.program = settings.program;
    identity.key = key;
    return identity;
}

double millisecondsBetween(BotTime from, BotTime to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

}  // namespace

base::Result<PlayerKey> botKey(const BotSettings& settings, int number) {
    if (settings.keyFolder.empty()) return newPlayerKey();
    return loadPlayerKey(std::filesystem::path(settings.keyFolder) / (botName(settings, number) + ".key"));
}

Bot::Bot(boost::asio::io_context& context, BotWorld& world, const BotSettings& settings, int number,
         const PlayerKey& key)
    : world_(world),
      settings_(settings),
      random_(static_cast<std::uint32_t>(number)),
      number_(number),
      builds_(settings.behaviour == BotBehaviour::Build ||
              std::fmod(number * settings.builders, 1.0) + settings.builders >= 1.0),
      link_(context, settings.servers[static_cast<std::size_t>(number) % settings.servers.size()],
            identityOf(settings, number, key),
            {[](const std::string&) { return true; },
             [this](const WorldOffer& offer) { return world_.land.prove(offer); },
             [this](const ServerMessage& message) { onMessage(message); },
             [this](const WorldOffer& offer) { return missingPacks(world_.land.packs, offer); },
             [this](const PackOffer& offer, const Bytes& archive) {
                 return takePack(world_.land.packs, offer, archive);
             }}) {}

void Bot::onMessage(const ServerMessage& message) {
    std::visit(base::Match{
                   [this](const Joined& joined) { onJoined(joined); },
                   [this](const ViewComplete&) { onViewComplete(); },
                   [this](const BlocksChanged& changed) { onBlocks(changed); },
                   [this](const Done& done) { onDone(done); },
                   [this](const Corrected& corrected) {
                       pose_ = poseOf(corrected.pose);
                       ++world_.corrections;
                   },
                   [](const auto&) {},  // a bot looks at nothing else and listens to nobody
               },
               message);
}

void Bot::onJoined(const Joined& joined) {
    ++world_.joins;
    player_ = joined.player;
    pose_ = poseOf(joined.pose);
    if (!world_.crowd) world_.crowd = pose_;
    home_ = settings_.behaviour == BotBehaviour::Crowd ? *world_.crowd : pose_;
    // Edits without an answer may have been applied or not.
    for (const world::BlockPos pos : undecided()) {
        world_.acknowledged.erase(pos);
        world_.unknown.insert(pos);
    }
    pending_.clear();
    toldView_.reset();
    moved_ = builtAt_ = std::chrono::steady_clock::now();
    chooseGoal();
    sendView();
}

void Bot::onViewComplete() {
    if (std::exchange(knowsView_, true)) return;
    world_.joinedKb.push_back(static_cast<double>(link_.receivedBytes() + link_.sentBytes()) / 1000);
    world_.joinedMs.push_back(millisecondsBetween(beganAt_, std::chrono::steady_clock::now()));
}

std::vector<world::BlockPos> Bot::undecided() const {
    std::vector<world::BlockPos> positions;
    for (const auto& [command, pending] : pending_) positions.push_back(pending.pos);
    return positions;
}

void Bot::onBlocks(const BlocksChanged& changed) {
    if (world_.unseen.empty()) return;
    for (const ChangedBlock& block : changed.blocks) {
        const auto sent = world_.unseen.find(world::blockPos(changed.chunk, block.index));
        if (sent == world_.unseen.end() || sent->second.by == player_) continue;
        if (settings_.servers.size() > 1 && sent->second.server == textOf(link_.address())) continue;
        world_.seenMs.push_back(millisecondsBetween(sent->second.at, std::chrono::steady_clock::now()));
        world_.unseen.erase(sent);
    }
}

void Bot::onDone(const Done& done) {
    const auto found = pending_.find(done.number);
    if (found == pending_.end()) return;
    world_.decidedMs.push_back(millisecondsBetween(found->second.at, std::chrono::steady_clock::now()));
    const auto result = static_cast<game::EditResult>(done.result);
    if (result == game::EditResult::Applied) {
        world_.acknowledged[found->second.pos] = found->second.id;
        world_.unknown.erase(found->second.pos);
    } else {
        ++world_.refused;
    }
    pending_.erase(found);
}

void Bot::chooseGoal() {
    const double roam = settings_.behaviour == BotBehaviour::Crowd ? kCrowdRoam : kRoam;
    std::uniform_real_distribution<double> away(-roam, roam);
    goal_ = {home_.position.x + away(random_), home_.position.y + away(random_)};
}

// Straight to the goal, on the generated ground; climbs and descends at any speed.
void Bot::walk(double seconds) {
    const glm::dvec2 here(pose_.position), way = goal_ - here;
    const double distance = glm::length(way), step = std::min(kWalkSpeed * seconds, distance);
    if (distance < 0.5) return chooseGoal();
    const glm::dvec2 next = here + way / distance * step;
    const world::BlockPos below = world::blockOf({next, 0});
    const int ground = world_.land.groundHeight(below.x, below.y);
    pose_.position = {next, ground + 1 + world::kEyeHeight};
    pose_.yaw = static_cast<float>(std::atan2(way.y, way.x) * 180 / std::numbers::pi);
}

// Places a block near the feet, or removes one that this bot placed.
void Bot::build(BotTime now) {
    builtAt_ = now;
    std::uniform_int_distribution<int> away(-3, 3), up(1, 3);
    world::BlockPos pos = world::blockOf(pose_.position);
    pos.x += away(random_);
    pos.y += away(random_);
    pos.z = world_.land.heights().clamp(world_.land.groundHeight(pos.x, pos.y) + up(random_));
    if (world_.owners.try_emplace(pos, number_).first->second != number_) return;
    const auto known = world_.acknowledged.find(pos);
    const bool isThere = known != world_.acknowledged.end() && known->second != world::kAir;
    const world::BlockId id = isThere ? world::kAir : world_.land.blocks().find("stone")->id;
    const CommandNumber number = ++lastCommand_;
    pending_[number] = {now, pos, id};
    world_.unseen[pos] = {now, player_, textOf(link_.address())};
    ++world_.edits;
    link_.send(Edit{number, pos, world::SetBlock{id, 0}, std::nullopt});
}

void Bot::sendView() {
    const world::ChunkPos center = world::chunkOf(pose_.position);
    if (toldView_ == center) return;
    toldView_ = center;
    link_.send(View{center, static_cast<std::uint8_t>(settings_.viewDistance), 0});
}

void Bot::update(BotTime now) {
    link_.update(now);
    const bool isJoined = link_.stage() == ClientLink::Stage::Joined;
    world_.cuts += wasJoined_ && !isJoined;
    wasJoined_ = isJoined;
    if (!isJoined || now - moved_ < kBotMovesEvery) return;
    walk(std::chrono::duration<double>(now - moved_).count());
    moved_ = now;
    link_.send(Move{wirePose(pose_)});
    sendView();
    const std::chrono::duration<double> sinceEdit = now - builtAt_;
    if (builds_ && sinceEdit.count() * settings_.editsPerSecond >= 1) build(now);
}

}  // namespace terrane::net
