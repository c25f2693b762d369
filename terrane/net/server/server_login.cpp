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

using Stage = ServerClient::Stage;

constexpr std::size_t kMaxUnsentParts = 2;
constexpr std::size_t kMaxWaitingPasswords = 32;
constexpr std::ptrdiff_t kMaxPasswordsOfAddress = 4;

// Sends the requested part of a content pack. Each pack is sent once per connection, from beginning to end; a
// request out of order is refused.
void onAskPack(ServerClients& clients, ServerClient& client, const std::vector<OfferedPack>& packs,
               const AskPack& ask) {
    client.sentOfPacks.resize(packs.size());
    const bool isNext = ask.number < packs.size() && ask.offset == client.sentOfPacks[ask.number] &&
                        ask.offset < packs[ask.number].archive->size();
    if (!isNext)
        return refuse(clients, client, Refusal::ProtocolError, "this part of a pack is not the next one");
    // Clients request a part after the previous one arrived; this bounds the memory for clients that do not
    // read.
    if (client.outgoing.size() + client.unsent > kMaxUnsentParts * kMaxPackPart)
        return refuse(clients, client, Refusal::TooSlow, "parts of packs were asked for that are not read");
    const Bytes& archive = *packs[ask.number].archive;
    const std::size_t count = std::min<std::size_t>(kMaxPackPart, archive.size() - ask.offset);
    const auto begin = archive.begin() + static_cast<std::ptrdiff_t>(ask.offset);
    send(client, PackPart{ask.number, ask.offset, Bytes(begin, begin + static_cast<std::ptrdiff_t>(count))});
    client.sentOfPacks[ask.number] += static_cast<std::uint32_t>(count);
    ++client.packParts;
}

// Login time of a client that downloads packs, in addition to ServerSettings::loginWithin: a second for each
// part, plus time to load the packs.
std::chrono::seconds timeForPacks(const ServerClient& client) {
    return std::chrono::seconds(client.packParts == 0 ? 0 : 20 + client.packParts);
}

void onHello(ServerClients& clients, ServerClient& client, const Hello& hello, const std::string& program,
             bool needsPassword) {
    if (hello.version != kProtocolVersion)
        return refuse(clients, client, Refusal::Version,
                      fmt::format("this server speaks version {} of the protocol, your program version {}",
                                  kProtocolVersion, hello.version));
    fillRandom(client.nonce);
    client.stage = Stage::Login;
    send(client, Greeting{program, client.nonce, needsPassword});
}

// Refuses the login if the ban, the name or a player limit forbids it.
void refuseStranger(ServerClients& clients, ServerClient& client) {
    const ServerSettings& settings = clients.settings;
    const KnownPlayer* known = clients.known.byKey(client.key);
    if (known && !known->ban.empty()) return refuse(clients, client, Refusal::Banned, banText(known->ban));
    // A player keeps the name by which the server knows it.
    const bool isKept = known && known->name == client.name;
    const game::PlayerId own = known ? known->id : game::kNoPlayer;
    if (const KnownPlayer* named = isKept ? nullptr : clients.known.byLooks(client.name, own))
        return refuse(
            clients, client, Refusal::Name,
            isSameName(named->name, client.name)
                ? fmt::format("the name {} belongs to another player: choose another", client.name)
                : fmt::format("the name {} looks like {}, the name of another player: choose another",
                              client.name, named->name));
    const auto isHere = [&](const ServerClient& other) {
        return other.stage == Stage::Playing && other.address.network == client.address.network &&
               other.key != client.key;
    };
    const auto ofAddress =
        std::ranges::count_if(clients.all, [&](const auto& entry) { return isHere(entry.second); });
    if (!client.address.isOwnMachine && std::cmp_greater_equal(ofAddress, settings.maxPlayersOfAddress))
        return refuse(clients, client, Refusal::Full,
                      fmt::format("{} players from your address are online already", ofAddress));
    const bool isAgain = known && clients.playing.contains(known->id);
    const bool isOperator = known && known->role == game::Role::Operator;
    if (clients.playing.size() >= settings.maxPlayers && !isAgain && !isOperator)
        refuse(clients, client, Refusal::Full,
               fmt::format("the server is full: {} players", settings.maxPlayers));
}

void offerWorld(ServerClient& client, const ServerOffer& offer) {
    client.stage = Stage::Proof;
    WorldOffer message{offer.fingerprint, offer.samples, {}};
    for (const OfferedPack& pack : offer.packs) message.packs.push_back(pack.offer);
    send(client, message);
}

// In a full queue, the address with the most waiting clients loses its last one to an address with fewer.
bool hasRoomForPassword(ServerClients& clients, ServerPassword& password, std::ptrdiff_t ofAddress) {
    std::deque<ServerPassword::Waiting>& queue = password.queue;
    if (queue.size() < kMaxWaitingPasswords) return true;
    const auto networkOf = [&](const ServerPassword::Waiting& waiting) -> const std::string& {
        return clients.all.at(waiting.client).address.network;
    };
    std::map<std::string, std::ptrdiff_t> counts;
    for (const ServerPassword::Waiting& waiting : queue) ++counts[networkOf(waiting)];
    const auto most = std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; });
    if (most->second <= ofAddress + 1) return false;
    const auto last = std::find_if(queue.rbegin(), queue.rend(), [&](const ServerPassword::Waiting& waiting) {
        return networkOf(waiting) == most->first;
    });
    refuse(clients, clients.all.at(last->client), Refusal::Full, "too many players log in: try again soon");
    queue.erase(std::next(last).base());
    return true;
}

// Checks the password if there is one, which takes some ticks, and offers the world.
void onLogin(ServerClients& clients, ServerClient& client, ServerPassword& password, const ServerOffer& offer,
             const Login& login) {
    if (!isName(login.name)) return refuse(clients, client, Refusal::Name, nameRule());
    const Bytes text = loginText(client.channel, client.nonce, login.name);
    if (!isSignedBy(login.key, text, login.signature))
        return refuse(clients, client, Refusal::WrongKey, "the signature does not fit the key");
    client.key = login.key;
    client.name = login.name;
    const KnownPlayer* known = clients.known.byKey(login.key);
    if (!known || known->name != login.name) {
        auto name = newName(login.name);
        if (!name) return refuse(clients, client, Refusal::Name, name.error().message);
        client.name = std::move(*name);
    }
    refuseStranger(clients, client);
    if (client.stage == Stage::Closed) return;
    if (password.hash.empty()) return offerWorld(client, offer);
    // Drop entries of clients that are gone.
    std::erase_if(password.queue, [&](const ServerPassword::Waiting& waiting) {
        const auto found = clients.all.find(waiting.client);
        return found == clients.all.end() || found->second.stage != Stage::Password;
    });
    const auto ofAddress = std::ranges::count_if(password.queue, [&](const ServerPassword::Waiting& waiting) {
        return clients.all.at(waiting.client).address.network == client.address.network;
    });
    const bool isOwn = client.address.isOwnMachine;
    if ((!isOwn && ofAddress >= kMaxPasswordsOfAddress) || !hasRoomForPassword(clients, password, ofAddress))
        return refuse(clients, client, Refusal::Full, "too many players log in: try again soon");
    client.stage = Stage::Password;
    password.queue.push_back({client.id, login.password});
}

void startPasswordCheck(ServerPassword& password, base::JobSystem& jobs) {
    ServerPassword::Waiting next = std::move(password.queue.front());
    password.queue.pop_front();
    ServerPassword::Check check{next.client, {}};
    check.job = jobs.submit(-1, [fits = check.fits, hash = password.hash, typed = std::move(next.password)] {
        *fits = fitsPassword(hash, typed);
    });
    password.running = check;
}

void finishPasswordCheck(ServerClients& clients, ServerPassword& password, const ServerOffer& offer) {
    const ServerPassword::Check check = *password.running;
    const base::JobState state = check.job.state();
    if (state == base::JobState::Queued || state == base::JobState::Running) return;
    password.running.reset();
    const auto found = clients.all.find(check.client);
    if (found == clients.all.end() || found->second.stage != Stage::Password) return;
    if (state == base::JobState::Done && *check.fits) return offerWorld(found->second, offer);
    refuse(clients, found->second, Refusal::Password, "the password is wrong");
}

// The bodies of all players of the world.
std::vector<world::Aabb> bodiesOf(const ServerClients& clients) {
    std::vector<world::Aabb> bodies;
    const auto add = [&](const world::Pose& pose) {
        bodies.push_back(world::characterBox(pose.position - glm::dvec3(0, 0, world::kEyeHeight)));
    };
    for (const auto& [player, connection] : clients.playing) add(poseOf(clients.all.at(connection).pose));
    for (const auto& [player, elsewhere] : clients.elsewhere) add(poseOf(elsewhere.at.pose));
    return bodies;
}

// A free place at the spawn, or around a random column that is at most `radius` blocks away.
world::Pose newcomersPose(game::Session& session, const ServerClients& clients, const world::Pose& spawn) {
    world::Pose pose = spawn;
    if (const int radius = clients.settings.spawnRadius; radius > 0) {
        std::uint64_t bits = 0;
        fillRandom(std::as_writable_bytes(std::span(&bits, 1)));
        const auto away = [&](std::uint64_t part) {
            return static_cast<int>(part % static_cast<std::uint64_t>(2 * radius + 1)) - radius;
        };
        pose.position.x += away(bits & 0xFFFFFFFF);
        pose.position.y += away(bits >> 32);
        const world::BlockPos below = world::blockOf(pose.position);
        const world::Chunk chunk = session.generator().generate(world::chunkOf(below));
        const world::Heights heights = chunk.heights();
        int z = heights.top - 1;
        while (z > heights.bottom && chunk.block(world::blockIndex({below.x, below.y, z})) == world::kAir)
            --z;
        pose.position.z = z + 1 + world::kEyeHeight;
    }
    return game::freePlaceNear(pose, session, bodiesOf(clients));
}

// Rate limit for new players: each adds a permanent row to the records.
bool mayComeNew(ServerClients& clients, const ClientAddress& address) {
    const double most = clients.settings.newPlayersPerHour;
    return takeOfAddress(clients.newPlayers, address, {most / 3600, most}, clients.now);
}

// The player's row with its current name, added for a new player.
const KnownPlayer& rowOf(ServerClients& clients, const ServerClient& client, game::PlayerId newNumber) {
    const KnownPlayer* known = clients.known.byKey(client.key);
    if (!known) known = &clients.known.add(client.key, client.name, clients.settings.newcomers, newNumber);
    if (known->name != client.name) clients.known.setName(known->id, client.name);
    return *known;
}

// Rate limits continue from the player's last session.
bool mayJoinAgain(ServerClients& clients, ServerClient& client, game::PlayerId player) {
    const auto former = clients.former.find(player);
    if (former != clients.former.end()) client.buckets = former->second.buckets;
    const bool may = client.buckets.joins.take(1, clients.now);
    if (former != clients.former.end()) former->second.buckets = client.buckets;
    return may;
}

// No value for a player who has never left. A player whose server stopped continues at the last position seen
// on it.
std::optional<world::Pose> lastPose(const ServerClients& clients, const KnownPlayer& player) {
    const auto elsewhere = clients.elsewhere.find(player.id);
    return elsewhere == clients.elsewhere.end() ? player.pose : poseOf(elsewhere->second.at.pose);
}

// Reads the items of a player once: later ones are in the session. Other servers may have changed them.
void loadItems(ServerClients& clients, game::Session& session, const KnownPlayer& player) {
    if (session.knowsItems(player.id) && !clients.shared)
        return (void)session.act(player.id, game::SelectSlot{0});
    game::PlayerItems items;
    const auto text = clients.known.items(player.id);
    auto read =
        text && !text->empty() ? game::parsePlayerItems(*text) : base::Result<game::PlayerItems>(items);
    if (!text || !read)
        base::logError("the items of {}: {}", player.name, (text ? read.error() : text.error()).message);
    if (text && read) items = std::move(*read);
    session.setItems(player.id, std::move(items));
}

void join(ServerClients& clients, ServerClient& client, game::Session& session, const world::Pose& spawn,
          std::span<const OtherServer> servers) {
    const ServerSettings& settings = clients.settings;
    const bool needsNumber = clients.shared && !clients.known.byKey(client.key);
    const game::PlayerId number = needsNumber ? clients.shared->allocatePlayerId() : game::kNoPlayer;
    if (needsNumber && number == game::kNoPlayer)
        return refuse(clients, client, Refusal::Full, "too many new players come at once: try again soon");
    const KnownPlayer& player = rowOf(clients, client, number);
    if (ServerClient* former = playingClient(clients, player.id))
        refuse(clients, *former, Refusal::Replaced, "you joined again elsewhere");
    if (!mayJoinAgain(clients, client, player.id))
        return refuse(clients, client, Refusal::TooMuch, "you join too often: try again in some seconds");
    const std::optional<world::Pose> last = lastPose(clients, player);
    const world::Pose pose = last ? *last : newcomersPose(session, clients, spawn);
    client.stage = Stage::Playing;
    client.player = player.id;
    client.role = player.role;
    client.pose = wirePose(pose);
    client.heardAt = clients.now;
    clients.playing[player.id] = client.id;
    if (clients.shared) clients.shared->publishJoined(player.id);
    clients.former.erase(player.id);
    session.setPlayer(player.id, pose);
    session.permissions.roles[player.id] = player.role;
    send(client,
         Joined{player.id, player.role, static_cast<std::uint8_t>(settings.maxViewDistance), client.pose});
    send(client, clockOf(session.clock));
    loadItems(clients, session, player);
    send(client, itemsOf(session, player.id));
    base::logInfo("{} joined from {}", client.name, client.address.shown);
    broadcastChat(clients, {}, client.name + " joined");
    if (!servers.empty()) send(client, otherServers(servers));
    if (!settings.welcome.empty()) say(client, settings.welcome);
    clients.events.joined.notify({player.id, player.name});
}

// Whether the client may join. Other players may have joined since Login: its checks are repeated.
bool isAccepted(ServerClients& clients, ServerClient& client, const Proof& proof,
                const SampleDigests& digests) {
    if (proof.digests != digests)
        refuse(clients, client, Refusal::OtherWorld,
               "your program generates a different world than the server: use the same program");
    else
        refuseStranger(clients, client);
    if (client.stage != Stage::Proof) return false;
    if (clients.known.byKey(client.key) || mayComeNew(clients, client.address)) return true;
    refuse(clients, client, Refusal::Full, "too many new players came from your address: try again later");
    return false;
}

}  // namespace

void onLoginMessage(ServerState& server, ServerClient& client, const ClientMessage& message) {
    ServerClients& clients = server.clients;
    const ServerOffer& offer = server.offer;
    const auto at = [&](Stage stage, auto handle) {
        if (client.stage == stage)
            handle();
        else
            refuseUnexpected(clients, client, message);
    };
    std::visit(base::Match{
                   [&](const Hello& hello) {
                       const bool needsPassword = !server.password.hash.empty();
                       at(Stage::Hello,
                          [&] { onHello(clients, client, hello, offer.program, needsPassword); });
                   },
                   [&](const Login& login) {
                       at(Stage::Login, [&] { onLogin(clients, client, server.password, offer, login); });
                   },
                   [&](const AskPack& ask) {
                       at(Stage::Proof, [&] { onAskPack(clients, client, offer.packs, ask); });
                   },
                   [&](const Proof& proof) {
                       at(Stage::Proof, [&] {
                           if (!isAccepted(clients, client, proof, offer.digests)) return;
                           join(clients, client, server.session, offer.spawn, server.sharing.servers);
                           // Another server may have named places for the player meanwhile.
                           if (clients.shared) server.places.owners.forget(client.player);
                       });
                   },
                   [&](const OfPlay auto&) { refuseUnexpected(clients, client, message); },
               },
               message);
}

void updateLogins(ServerClients& clients, ServerPassword& password, const ServerOffer& offer,
                  base::JobSystem& jobs) {
    if (password.running) finishPasswordCheck(clients, password, offer);
    if (!password.running && !password.queue.empty()) startPasswordCheck(password, jobs);
    for (auto& [id, client] : clients.all) {
        const bool logsIn = client.stage != Stage::Playing && client.stage != Stage::Closed;
        if (logsIn && clients.now - client.openedAt > clients.settings.loginWithin + timeForPacks(client))
            refuse(clients, client, Refusal::Silent, "the login took too long");
    }
}

}  // namespace terrane::net
