// libFuzzer: actions of connections on a server (net/server/server.h) in any order: open, close, log in, send
// valid, nearly valid or random messages, while time passes. One server for all inputs, with a flat world in
// memory; between inputs all clients leave. Its answers must be messages that a client can decode.
#include <array>
#include <memory>

#include "terrane/base/log.h"
#include "terrane/content/built_in.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/net/client/client_link.h"
#include "terrane/net/server/server_console.h"
#include "terrane/net/server/server_loop.h"
#include "terrane/net/server/sqlite_records.h"
#include "terrane/net/wire/wire.h"
#include "terrane/store/chunks/structure_file.h"
#include "terrane/store/overlay_store.h"
#include "tests/fuzz/fuzz_folder.h"

namespace {

using namespace terrane;
using fuzz::FuzzInput;
using fuzz::require;

constexpr std::size_t kConnections = 4;
constexpr std::int64_t kMaxEdits = 5000;  // in the history, which is then cleared

// Limits per client: waiting edits, and unsent bytes (ServerSettings::maxUnsentBytes and a tick).
constexpr std::size_t kMaxCommands = 512, kMaxOutgoing = 12 << 20;

struct Connection {
    net::ConnectionId id = 0;  // 0: closed
    net::Bytes channel = net::Bytes(32);
    net::FrameReader reader{net::kMaxClientMessage};  // of raw bytes that it sends
    net::FrameReader answers{net::kMaxServerMessage};
    std::optional<net::Greeting> greeting;
};

net::ServerHost openHost() {
    base::setLogLevel(base::LogLevel::Silent);
    auto blocks = std::make_unique<const world::BlockRegistry>(content::loadBlocks().value());
    auto generators = gen::makeLevelGenerators("flat", *blocks, 1).value();
    auto store = std::make_unique<store::MemoryStore>(
        store::WorldIdentity{1, "flat", gen::versionOf(gen::builtInGenerators(), "flat")});
    game::SessionParts parts{std::move(blocks), std::move(generators), std::move(store), 1};
    auto records = net::SqliteRecords::open(fuzz::fuzzFolder() / "w.server.sqlite", *parts.blocks).value();
    // Two packs; the server does not look into them.
    net::ServerContent content;
    for (const std::size_t size : {net::kMaxPackPart + 1, std::size_t{10}})
        content.packs.push_back(
            {{fmt::format("p{}", content.packs.size()), "", {}, static_cast<std::uint32_t>(size)},
             std::make_shared<net::Bytes>(size)});
    return net::openServerHost(std::move(parts), std::move(records), {}, "fuzz", content).value();
}

class FuzzServer {
  public:
    FuzzServer() : host_(openHost()) {
        for (std::size_t k = 0; k < kConnections; ++k) {
            std::array<std::byte, 32> seed{};
            seed[0] = static_cast<std::byte>(k + 1);
            identities_[k] = {fmt::format("P{}", k), net::playerKeyFrom(seed), {}, "fuzz"};
        }
    }

    void run(FuzzInput& in) {
        // Loads chunks near the spawn, so that edits apply at once.
        stream::ChunkPipeline& pipeline = server().session.pipeline();
        const auto near = world::chunksWithin(world::chunkOf(server().offer.spawn.position), 1);
        for (const world::ChunkPos pos : near) (void)pipeline.maybeLoadChunkAt(pos);
        for (const world::ChunkPos pos : near) (void)pipeline.chunkAt(pos);
        while (!in.isEmpty()) {
            act(in);
            checkLimits();
        }
        reset();
    }

  private:
    net::ServerState& server() { return *host_.state; }

    void act(FuzzInput& in) {
        const std::uint8_t what = in.byte();
        Connection& connection = connections_[what % kConnections];
        switch (what / kConnections % 10) {
            case 0:
                return open(connection);
            case 1:
                return close(connection);
            case 2:
                return logIn(connection, in.byte());
            case 3:
                return say(connection, message(in));
            case 4:
                return say(connection, mutated(message(in), in));
            case 5:
                return say(connection, toBytes(in.bytes(in.byte())));
            case 6:
                return stream(connection, toBytes(in.bytes(in.byte())));
            case 7:
                return tick(1 + in.byte() % 16);
            case 8:
                return giveCommand(in);
            default:
                return wait(in.byte());
        }
    }

    void open(Connection& connection) {
        close(connection);
        connection.id = ++lastId_;
        connection.channel[0] = static_cast<std::byte>(lastId_);
        onOpened(server(), connection.id, connection.channel, {"fuzz", "fuzz", false}, now_);
    }
    void close(Connection& connection) {
        if (connection.id != 0) onClosed(server(), connection.id, now_);
        connection = {};
    }
    void logIn(Connection& connection, std::uint8_t who) {
        const net::ClientIdentity& identity = identities_[who % kConnections];
        if (connection.id == 0) open(connection);
        say(connection, encode(net::ClientMessage(helloOf(identity))));
        if (!connection.greeting) return;
        say(connection,
            encode(net::ClientMessage(loginOf(identity, *connection.greeting, connection.channel))));
        // Without the proof, it may ask for packs.
        if (who < 0xC0) say(connection, encode(net::ClientMessage(net::Proof{server().offer.digests})));
    }
    void say(Connection& connection, const net::Bytes& bytes) {
        if (connection.id == 0) return;
        onMessage(server(), connection.id, bytes, now_);
        read(connection);
    }
    // Passes bytes to the server as net/server/server_sockets.h does.
    void stream(Connection& connection, const net::Bytes& bytes) {
        if (connection.id == 0) return;
        connection.reader.add(bytes);
        while (true) {
            const auto frame = connection.reader.next();
            if (!frame) return onMalformedMessage(server(), connection.id, frame.error().message, now_);
            if (!*frame) return read(connection);
            onMessage(server(), connection.id, **frame, now_);
        }
    }
    void read(Connection& connection) {
        const auto client = server().clients.all.find(connection.id);
        if (client == server().clients.all.end()) return;
        connection.answers.add(std::exchange(client->second.outgoing, {}));
        while (true) {
            const auto frame = connection.answers.next();
            require(frame.has_value());
            if (!*frame) return;
            auto message = net::decodeServerMessage(**frame);
            require(message.has_value());
            if (const auto* greeting = std::get_if<net::Greeting>(&*message)) connection.greeting = *greeting;
        }
    }
    void tick(int count) {
        for (int k = 0; k < count; ++k) net::tick(server(), now_ += net::kServerTick);
        for (Connection& connection : connections_)
            if (connection.id != 0) read(connection);
    }
    void wait(std::uint8_t seconds) {
        now_ += std::chrono::seconds(seconds % 30);
        tick(1);
    }
    // Skips commands with passwords: hashing one takes 64 MiB and much time.
    void giveCommand(FuzzInput& in) {
        const std::string_view line = in.text();
        if (line.find("password") == std::string_view::npos) (void)runConsoleLine(server(), line);
    }

    static net::Bytes toBytes(std::span<const std::uint8_t> bytes) {
        const auto* data = reinterpret_cast<const std::byte*>(bytes.data());
        return {data, data + bytes.size()};
    }
    static net::Bytes mutated(net::Bytes bytes, FuzzInput& in) {
        const std::uint64_t at = in.number(2);
        if (!bytes.empty()) bytes[at % bytes.size()] ^= static_cast<std::byte>(in.byte());
        return bytes;
    }
    std::int32_t near(double origin, FuzzInput& in) {
        const auto offset = static_cast<std::int8_t>(in.byte());
        // Also near the limits of the type.
        if (offset == -128) return std::numeric_limits<std::int32_t>::min() + in.byte();
        if (offset == 127) return std::numeric_limits<std::int32_t>::max() - in.byte();
        return static_cast<std::int32_t>(origin) + offset / 4;
    }
    world::BlockPos pos(FuzzInput& in) {
        const auto& spawn = server().offer.spawn.position;
        const std::int32_t x = near(spawn.x, in), y = near(spawn.y, in);
        const auto offset = static_cast<std::int8_t>(in.byte());
        // Also beyond the limits of the world, and of all worlds.
        if (offset == -128) return {x, y, -1};
        if (offset == 127) return {x, y, world::kHighestTop};
        return {x, y, std::clamp(static_cast<int>(spawn.z) + offset / 4, 0, 256)};
    }
    world::BlockId block(FuzzInput& in) {
        const std::uint8_t id = in.byte();
        return id == 255 ? static_cast<world::BlockId>(in.number(2)) : id;
    }
    game::FillShape shape(FuzzInput& in) {
        const std::uint8_t bits = in.byte();
        return {static_cast<game::ShapeKind>(bits / 4 % static_cast<std::uint8_t>(game::ShapeKind::Count)),
                (bits & 1) != 0, (bits & 2) != 0};
    }
    world::BlockChange change(FuzzInput& in) {
        const std::uint8_t kind = in.byte() % 4;
        if (kind == 0) return world::UseBlock{};
        if (kind == 1) return world::SetEntityData{toBytes(in.bytes(in.byte()))};
        return world::SetBlock{block(in), static_cast<std::uint16_t>(kind == 2 ? 0 : in.number(2))};
    }
    net::Bytes structure(FuzzInput& in) {
        world::Structure made;
        made.size = {1 + in.byte() % 8, 1 + in.byte() % 8, 1 + in.byte() % 8};
        made.palette = {{server().session.blocks().type(block(in)).name, in.byte()}};
        made.cells.assign(static_cast<std::size_t>(made.blockCount()), 0);
        return store::encodeStructure(made).value_or(net::Bytes());
    }
    net::Bytes message(FuzzInput& in) { return encode(messageOf(in)); }
    net::ClientMessage messageOf(FuzzInput& in) {
        const net::CommandNumber number = ++lastCommand_;
        const std::uint8_t kind = in.byte();
        switch (kind % 12) {
            case 0:
                return net::Edit{number, pos(in), change(in), {}};
            case 1:
                return net::Edit{number, pos(in), change(in), block(in)};
            case 2:
                return net::Fill{number, {{pos(in), pos(in)}, block(in), in.byte(), {}, shape(in)}};
            case 3:
                return net::Fill{number, {{pos(in), pos(in)}, block(in), 0, block(in), shape(in)}};
            case 4:
                return net::Place{number, pos(in), structure(in)};
            case 5:
                return net::TakeBack{number, in.byte() % 2 == 1};
            case 6: {
                const world::BlockPos at = pos(in);
                return net::Move{net::wirePose({{at.x + 0.5, at.y + 0.5, at.z + 0.5}, 0, 0})};
            }
            case 7:
                return net::View{world::chunkOf(pos(in)), in.byte(), static_cast<std::uint16_t>(in.number(2)),
                                 pos(in).z};
            case 8:
                return net::Say{std::string(in.text())};
            case 9:
                return net::Pong{static_cast<std::uint32_t>(in.number(4))};
            case 10:
                if (kind < 128) return net::AskPlayers{};
                return net::AskPack{static_cast<std::uint8_t>(in.byte() % 4),
                                    static_cast<std::uint32_t>(in.byte() % 3 * net::kMaxPackPart)};
            default:
                return net::Leave{};
        }
    }

    void checkLimits() {
        for (const auto& [id, client] : server().clients.all) {
            require(client.commands.size() <= kMaxCommands && client.waitingBytes <= kMaxCommands << 16);
            require(client.outgoing.size() <= kMaxOutgoing);
        }
        require(server().clients.all.size() <= kConnections &&
                server().clients.playing.size() <= kConnections);
        require(server().password.queue.empty());
    }

    // Restores the initial state, except for built blocks.
    void reset() {
        for (Connection& connection : connections_) close(connection);
        require(server().clients.all.empty() && server().clients.playing.empty());
        for (const auto& [player, since] : server().clients.former) server().session.removePlayer(player);
        server().clients.former.clear();
        server().history.rollbacks.clear();
        server().isStopping = false;
        while (!server().clients.known.claims().all().empty())
            require(server().clients.known.removeClaim(
                std::string(server().clients.known.claims().all().front().name)));
        server().session.permissions.claims = {};
        for (const net::ClientIdentity& identity : identities_) {
            const net::KnownPlayer* player = server().clients.known.byName(identity.name);
            if (player && !player->ban.empty()) (void)runConsoleLine(server(), "unban " + identity.name);
            if (player && player->role != game::Role::Player)
                (void)runConsoleLine(server(), "deop " + identity.name);
        }
        net::tick(server(), now_ += net::kServerTick);
        if (server().history.newest > forgotten_ + kMaxEdits) forgetHistory();
    }
    void forgetHistory() {
        forgotten_ = server().history.newest;
        auto& records = static_cast<net::SqliteRecords&>(server().history.records);
        records.file().write([](store::Database& database) { return database.execute("DELETE FROM edits"); });
        require(records.flush().has_value());
    }

    net::ServerHost host_;
    net::Time now_ = std::chrono::steady_clock::now();
    net::ConnectionId lastId_ = 0;
    net::CommandNumber lastCommand_ = 0;
    std::int64_t forgotten_ = 0;
    std::array<Connection, kConnections> connections_;
    std::array<net::ClientIdentity, kConnections> identities_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static auto* const server = new FuzzServer;  // lives until the process ends
    FuzzInput in(data, size);
    server->run(in);
    return 0;
}
