#include "terrane/net/server/server_login.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/match.h"
#include "terrane/game/spawn.h"
#include "terrane/net/server/server_clients.h"
#include "terrane/net/sharing/other_servers.h"
#include "terrane/net/wire/security.h"
#include "terrane/world/character.h"

namespace terrane::net {

namespace {

constexpr std::size_t kMaxUnsentParts = 2;

}  // namespace

void onAskPack(ServerState& server, ServerClient& client, const AskPack& ask) {
    client.sentOfPacks.resize(server.packs.size());
    const bool isNext = ask.number < server.packs.size() && ask.offset == client.sentOfPacks[ask.number] &&
                        ask.offset < server.packs[ask.number].archive->size();
    if (!isNext)
        return refuse(server, client, Refusal::ProtocolError, "this part of a pack is not the next one");
    // Clients request a part after the previous one arrived; this bounds the memory for clients that do not
    // read.
    if (client.outgoing.size() + client.unsent > kMaxUnsentParts * kMaxPackPart)
        return refuse(server, client, Refusal::TooSlow, "parts of packs were asked for that are not read");
    const Bytes& archive = *server.packs[ask.number].archive;
    const std::size_t count = std::min<std::size_t>(kMaxPackPart, archive.size() - ask.offset);
    const auto begin = archive.begin() + static_cast<std::ptrdiff_t>(ask.offset);
    send(client, PackPart{ask.number, ask.offset, Bytes(begin, begin + static_cast<std::ptrdiff_t>(count))});
    client.sentOfPacks[ask.number] += static_cast<std::uint32_t>(count);
    ++client.packParts;
}

// Allows a second for each part, plus time to load the packs.
std::chrono::milliseconds timeForPacks(const ServerClient& client) {
    return client.packParts == 0 ? std::chrono::seconds(0) : std::chrono::seconds(20 + client.packParts);
}

namespace {

using Stage = ServerClient::Stage;

constexpr std::size_t kMaxWaitingPasswords = 32;
constexpr std::ptrdiff_t kMaxPasswordsOfAddress = 4;

void onHello(ServerState& server, ServerClient& client, const Hello& hello) {
    if (hello.version != kProtocolVersion)
        return refuse(server, client, Refusal::Version,
                      fmt::format("this server speaks version {} of the protocol, your program version {}",
                                  kProtocolVersion, hello.version));
    fillRandom(client.nonce);
    client.stage = Stage::Login;
    send(client, Greeting{server.program, client.nonce, !server.passwordHash.empty()});
}

// Refuses the login if the ban, the name or a player limit forbids it.
void refuseStranger(ServerState& server, ServerClient& client) {
    const KnownPlayer* known = server.knownPlayers.byKey(client.key);
    if (known && !known->ban.empty()) return refuse(server, client, Refusal::Banned, banText(known->ban));
    // A player keeps the name by which the server knows it.
    const bool isKept = known && known->name == client.name;
    const game::PlayerId own = known ? known->id : game::kNoPlayer;
    if (const KnownPlayer* named = isKept ? nullptr : server.knownPlayers.byLooks(client.name, own))
        return refuse(
            server, client, Refusal::Name,
            isSameName(named->name, client.name)
                ? fmt::format("the name {} belongs to another player: choose another", client.name)
                : fmt::format("the name {} looks like {}, the name of another player: choose another",
                              client.name, named->name));
    const auto isHere = [&](const ServerClient& other) {
        return other.stage == Stage::Playing && other.address.network == client.address.network &&
               other.key != client.key;
    };
    const auto ofAddress =
        std::ranges::count_if(server.clients, [&](const auto& entry) { return isHere(entry.second); });
    if (!client.address.isOwnMachine &&
        std::cmp_greater_equal(ofAddress, server.settings.maxPlayersOfAddress))
        return refuse(server, client, Refusal::Full,
                      fmt::format("{} players from your address are online already", ofAddress));
    const bool isAgain = known && server.playing.contains(known->id);
    const bool isOperator = known && known->role == game::Role::Operator;
    if (server.playing.size() >= server.settings.maxPlayers && !isAgain && !isOperator)
        refuse(server, client, Refusal::Full,
               fmt::format("the server is full: {} players", server.settings.maxPlayers));
}

void offerWorld(ServerState& server, ServerClient& client) {
    client.stage = Stage::Proof;
    WorldOffer offer{server.world, server.samples, {}};
    for (const OfferedPack& pack : server.packs) offer.packs.push_back(pack.offer);
    send(client, offer);
}

// In a full queue, the address with the most waiting clients loses its last one to an address with fewer.
bool hasRoomForPassword(ServerState& server, std::ptrdiff_t ofAddress) {
    std::deque<WaitingPassword>& queue = server.passwordQueue;
    if (queue.size() < kMaxWaitingPasswords) return true;
    const auto networkOf = [&](const WaitingPassword& waiting) -> const std::string& {
        return server.clients.at(waiting.client).address.network;
    };
    std::map<std::string, std::ptrdiff_t> counts;
    for (const WaitingPassword& waiting : queue) ++counts[networkOf(waiting)];
    const auto most = std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; });
    if (most->second <= ofAddress + 1) return false;
    const auto last = std::find_if(queue.rbegin(), queue.rend(), [&](const WaitingPassword& waiting) {
        return networkOf(waiting) == most->first;
    });
    refuse(server, server.clients.at(last->client), Refusal::Full, "too many players log in: try again soon");
    queue.erase(std::next(last).base());
    return true;
}

void onLogin(ServerState& server, ServerClient& client, const Login& login) {
    if (!isName(login.name)) return refuse(server, client, Refusal::Name, nameRule());
    const Bytes text = loginText(client.channel, client.nonce, login.name);
    if (!isSignedBy(login.key, text, login.signature))
        return refuse(server, client, Refusal::WrongKey, "the signature does not fit the key");
    client.key = login.key;
    client.name = login.name;
    const KnownPlayer* known = server.knownPlayers.byKey(login.key);
    if (!known || known->name != login.name) {
        auto name = newName(login.name);
        if (!name) return refuse(server, client, Refusal::Name, name.error().message);
        client.name = std::move(*name);
    }
    refuseStranger(server, client);
    if (client.stage == Stage::Closed) return;
    if (server.passwordHash.empty()) return offerWorld(server, client);
    // Drop entries of clients that are gone.
    std::erase_if(server.passwordQueue, [&](const WaitingPassword& waiting) {
        const auto found = server.clients.find(waiting.client);
        return found == server.clients.end() || found->second.stage != Stage::Password;
    });
    const auto ofAddress = std::ranges::count_if(server.passwordQueue, [&](const WaitingPassword& waiting) {
        return server.clients.at(waiting.client).address.network == client.address.network;
    });
    const bool isOwn = client.address.isOwnMachine;
    if ((!isOwn && ofAddress >= kMaxPasswordsOfAddress) || !hasRoomForPassword(server, ofAddress))
        return refuse(server, client, Refusal::Full, "too many players log in: try again soon");
    client.stage = Stage::Password;
    server.passwordQueue.push_back({client.id, login.password});
}

void startPasswordCheck(ServerState& server) {
    WaitingPassword next = std::move(server.passwordQueue.front());
    server.passwordQueue.pop_front();
    PasswordCheck check{next.client, {}};
    check.job = server.jobs.submit(
        -1, [fits = check.fits, hash = server.passwordHash, password = std::move(next.password)] {
            *fits = fitsPassword(hash, password);
        });
    server.passwordCheck = check;
}

void finishPasswordCheck(ServerState& server) {
    const PasswordCheck check = *server.passwordCheck;
    const base::JobState state = check.job.state();
    if (state == base::JobState::Queued || state == base::JobState::Running) return;
    server.passwordCheck.reset();
    const auto found = server.clients.find(check.client);
    if (found == server.clients.end() || found->second.stage != Stage::Password) return;
    if (state == base::JobState::Done && *check.fits) return offerWorld(server, found->second);
    refuse(server, found->second, Refusal::Password, "the password is wrong");
}

// On top of a random column around the spawn.
world::Pose newcomersPose(const ServerState& server) {
    const int radius = server.settings.spawnRadius;
    if (radius == 0) return server.spawn;
    std::uint64_t bits = 0;
    fillRandom(std::as_writable_bytes(std::span(&bits, 1)));
    const auto away = [&](std::uint64_t part) {
        return static_cast<int>(part % static_cast<std::uint64_t>(2 * radius + 1)) - radius;
    };
    world::Pose pose = server.spawn;
    pose.position.x += away(bits & 0xFFFFFFFF);
    pose.position.y += away(bits >> 32);
    const world::BlockPos below = world::blockOf(pose.position);
    const world::Chunk chunk = server.session.generator().generate(world::chunkOf(below));
    int z = world::kChunkHeight - 1;
    while (z > 0 && chunk.block(world::blockIndex({below.x, below.y, z})) == world::kAir) --z;
    pose.position.z = z + 1 + world::kEyeHeight;
    return pose;
}

void replaceFormer(ServerState& server, const KnownPlayer& player) {
    if (ServerClient* former = playingClient(server, player.id))
        refuse(server, *former, Refusal::Replaced, "you joined again elsewhere");
}

// Rate limit for new players: each adds a permanent row to the records.
bool mayComeNew(ServerState& server, const ClientAddress& address) {
    const double most = server.settings.newPlayersPerHour;
    return takeOfAddress(server.newPlayers, address, {most / 3600, most}, server.now);
}

// The player's row with its current name, added for a new player.
const KnownPlayer& rowOf(ServerState& server, const ServerClient& client, game::PlayerId newNumber) {
    const KnownPlayer* known = server.knownPlayers.byKey(client.key);
    if (!known)
        known = &server.knownPlayers.add(client.key, client.name, server.settings.newcomers, newNumber);
    if (known->name != client.name) server.knownPlayers.setName(known->id, client.name);
    return *known;
}

// Rate limits continue from the player's last session.
bool mayJoinAgain(ServerState& server, ServerClient& client, game::PlayerId player) {
    const auto left = server.left.find(player);
    if (left != server.left.end()) client.buckets = left->second.buckets;
    const bool may = client.buckets.joins.take(1, server.now);
    if (left != server.left.end()) left->second.buckets = client.buckets;
    return may;
}

// A player whose server stopped continues at the last position seen on it.
world::Pose lastPose(const ServerState& server, const KnownPlayer& player) {
    const auto elsewhere = server.sharing.players.find(player.id);
    if (elsewhere != server.sharing.players.end()) return poseOf(elsewhere->second.at.pose);
    return player.pose ? *player.pose : newcomersPose(server);
}

void join(ServerState& server, ServerClient& client) {
    const bool needsNumber = server.sharing.shared && !server.knownPlayers.byKey(client.key);
    const game::PlayerId number = needsNumber ? server.sharing.shared->allocatePlayerId() : game::kNoPlayer;
    if (needsNumber && number == game::kNoPlayer)
        return refuse(server, client, Refusal::Full, "too many new players come at once: try again soon");
    const KnownPlayer& player = rowOf(server, client, number);
    replaceFormer(server, player);
    if (!mayJoinAgain(server, client, player.id))
        return refuse(server, client, Refusal::TooMuch, "you join too often: try again in some seconds");
    const world::Pose pose = lastPose(server, player);
    client.stage = Stage::Playing;
    client.player = player.id;
    client.role = player.role;
    client.pose = wirePose(pose);
    client.heardAt = server.now;
    server.playing[player.id] = client.id;
    if (server.sharing.shared) server.sharing.shared->publishJoined(player.id);
    server.left.erase(player.id);
    server.session.setPlayer(player.id, pose);
    server.session.permissions.roles[player.id] = player.role;
    if (server.sharing.shared) server.placeOwners.forget(player.id);
    send(client, Joined{player.id, player.role, static_cast<std::uint8_t>(server.settings.maxViewDistance),
                        client.pose});
    send(client, clockOf(server));
    base::logInfo("{} joined from {}", client.name, client.address.shown);
    broadcastChat(server, {}, client.name + " joined");
    if (!server.sharing.servers.empty()) send(client, otherServers(server));
    if (!server.settings.welcome.empty()) say(client, server.settings.welcome);
}

// Other players may have joined since Login: its checks are repeated.
void onProof(ServerState& server, ServerClient& client, const Proof& proof) {
    if (proof.digests != server.digests)
        return refuse(server, client, Refusal::OtherWorld,
                      "your program generates a different world than the server: use the same program");
    refuseStranger(server, client);
    if (client.stage != Stage::Proof) return;
    if (!server.knownPlayers.byKey(client.key) && !mayComeNew(server, client.address))
        return refuse(server, client, Refusal::Full,
                      "too many new players came from your address: try again later");
    join(server, client);
}

}  // namespace

void prepareLogin(ServerState& server, std::uint64_t random) {
    const game::Session& session = server.session;
    server.samples = samplePositions(random);
    server.digests = sampleDigests(session.generator(), server.samples);
    server.spawn = game::findSpawn(session.generator(), session.blocks());
}

void onLoginMessage(ServerState& server, ServerClient& client, const ClientMessage& message) {
    const auto at = [&](Stage stage, auto handle) {
        if (client.stage == stage)
            handle();
        else
            refuseUnexpected(server, client, message);
    };
    std::visit(base::Match{
                   [&](const Hello& hello) { at(Stage::Hello, [&] { onHello(server, client, hello); }); },
                   [&](const Login& login) { at(Stage::Login, [&] { onLogin(server, client, login); }); },
                   [&](const AskPack& ask) { at(Stage::Proof, [&] { onAskPack(server, client, ask); }); },
                   [&](const Proof& proof) { at(Stage::Proof, [&] { onProof(server, client, proof); }); },
                   base::on<View, Move, Edit, Fill, Place, TakeBack, Say, Pong, AskPlayers, Leave>(
                       [&] { refuseUnexpected(server, client, message); }),
               },
               message);
}

void updateLogins(ServerState& server) {
    if (server.passwordCheck) finishPasswordCheck(server);
    if (!server.passwordCheck && !server.passwordQueue.empty()) startPasswordCheck(server);
    for (auto& [id, client] : server.clients) {
        const bool logsIn = client.stage != Stage::Playing && client.stage != Stage::Closed;
        if (logsIn && server.now - client.openedAt > server.settings.loginWithin + timeForPacks(client))
            refuse(server, client, Refusal::Silent, "the login took too long");
    }
}

}  // namespace terrane::net
