#include "terrane/net/server/server_loop.h"

#include <unistd.h>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/streambuf.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <istream>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/process.h"
#include "terrane/base/text.h"
#include "terrane/game/player_state.h"
#include "terrane/game/spawn.h"
#include "terrane/net/server/server.h"
#include "terrane/net/server/server_console.h"
#include "terrane/net/wire/security.h"

namespace terrane::net {

base::Result<ServerHost> openServerHost(game::SessionParts parts, std::unique_ptr<ServerRecords> records,
                                        const ServerSettings& settings, const std::string& program,
                                        const ServerContent& content) {
    const store::WorldIdentity identity = parts.store->identity();
    auto graph = TERRANE_TRY(gen::makeGenerator(identity.generator, *parts.blocks,
                                                gen::GraphRequest{0, identity.heights}, content.generators));
    ServerOffer offer{program, worldFingerprint(identity, graph, *parts.blocks), content.packs};
    auto knownPlayers = TERRANE_TRY(KnownPlayers::read(*records));

    const auto tiles = std::make_shared<WrittenTiles>();
    parts.tileListener = [tiles](std::span<const world::ChunkPos> written) {
        const std::lock_guard lock(tiles->mutex);
        tiles->tiles.insert(tiles->tiles.end(), written.begin(), written.end());
    };
    ServerHost host;
    host.session = std::make_unique<game::Session>(std::move(parts));
    if (const auto time = game::loadPlayer(host.session->store()).timeDay)
        host.session->clock.timeDay = *time;
    host.records = std::move(records);
    host.knownPlayers = std::make_unique<KnownPlayers>(std::move(knownPlayers));
    std::uint64_t random = 0;
    fillRandom(std::as_writable_bytes(std::span(&random, 1)));
    const gen::Generator& generator = host.session->generator();
    offer.samples = samplePositions(random);
    offer.digests = sampleDigests(generator, offer.samples);  // generates chunks: up to 0.3 s
    offer.spawn = game::findSpawn(generator, host.session->blocks());
    auto state = TERRANE_TRY(
        openServer({*host.session, *host.records, *host.knownPlayers, tiles, std::move(offer)}, settings));
    host.state = std::move(state);
    return host;
}

namespace {

namespace asio = boost::asio;

constexpr std::size_t kMaxConsoleLine = 4096;
// Time for clients to read that the server stops.
constexpr std::chrono::seconds kStopTime{2};
constexpr std::chrono::milliseconds kLeastListening{5};
// After a longer stall, ticks are skipped instead of made up for.
constexpr int kMaxTicksBehind = 4;

void runLine(ServerState& server, const std::string& line) {
    const std::string answer = runConsoleLine(server, line);
    if (answer.empty()) return;
    for (std::size_t at = 0; at <= answer.size();) {
        const std::size_t end = std::min(answer.find('\n', at), answer.size());
        base::printLine("{}", std::string_view(answer).substr(at, end - at));
        at = end + 1;
    }
    std::fflush(stdout);  // a reader may wait at the other end of a pipe
}

void reportLongLine() {
    base::logError("a line of more than {} bytes is no command", kMaxConsoleLine);
}

#ifdef BOOST_ASIO_HAS_POSIX_STREAM_DESCRIPTOR

// Reads lines of standard input if it can be waited for: a terminal or pipe, not a file.
class Console {
  public:
    Console(asio::io_context& context, ServerState& server) : server_(server), input_(context) {
        boost::system::error_code failed;
        const int copy = ::dup(STDIN_FILENO);
        if (copy < 0) return;
        input_.assign(copy, failed);
        if (failed)
            ::close(copy);
        else
            read();
    }

  private:
    void read() {
        asio::async_read_until(input_, buffer_, '\n',
                               [this](const boost::system::error_code& error, std::size_t) { take(error); });
    }
    void take(const boost::system::error_code& error) {
        const bool isTooLong = error == asio::error::not_found;
        if (error && !isTooLong) return;
        std::istream lines(&buffer_);
        std::string line;
        std::getline(lines, line);
        if (isTooLong && !skipsLine_) reportLongLine();
        if (!isTooLong && !skipsLine_) runLine(server_, line);
        skipsLine_ = isTooLong;  // ignore the rest of the line, too
        read();
    }

    ServerState& server_;
    asio::posix::stream_descriptor input_;
    asio::streambuf buffer_{kMaxConsoleLine};
    bool skipsLine_ = false;
};

#else

// Reads lines of standard input on a thread: Windows can wait for neither consoles nor pipes together with
// sockets. The thread stays in its read when the server ends.
class Console {
  public:
    Console(asio::io_context& context, ServerState& server) : target_(std::make_shared<Target>()) {
        target_->context = &context;
        target_->server = &server;
        std::thread([target = target_] { readLines(*target, target); }).detach();
    }
    ~Console() {
        const std::lock_guard lock(target_->mutex);
        target_->context = nullptr;
    }

  private:
    struct Target {
        std::mutex mutex;
        asio::io_context* context = nullptr;  // null: the server has ended
        ServerState* server = nullptr;
    };

    static void readLines(Target& target, const std::shared_ptr<Target>& owner) {
        std::string line;
        bool isTooLong = false;
        for (int c = std::getchar(); c != EOF; c = std::getchar()) {
            if (c != '\n') {
                isTooLong = isTooLong || line.size() == kMaxConsoleLine;
                if (!isTooLong && c != '\r') line += static_cast<char>(c);
                continue;
            }
            const std::lock_guard lock(target.mutex);
            if (!target.context) return;
            asio::post(*target.context, [owner, line, isTooLong] {
                isTooLong ? reportLongLine() : runLine(*owner->server, line);
            });
            line.clear();
            isTooLong = false;
        }
    }

    std::shared_ptr<Target> target_;
};

#endif

double millisecondsSince(Time start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void sendGoodbye(asio::io_context& context, ServerSockets& sockets) {
    const Time end = std::chrono::steady_clock::now() + kStopTime;
    while (sockets.connectionCount() > 0 && std::chrono::steady_clock::now() < end) {
        sockets.flush();
        context.restart();
        context.run_for(std::chrono::milliseconds(20));
    }
}

}  // namespace

base::Result<void> runServer(asio::io_context& context, ServerState& server, ServerSockets& sockets,
                             const ServerLoop& loop) {
    const base::StopSignals signals;
    Console console(context, server);
    Time next = std::chrono::steady_clock::now();
    while (!server.isStopping && !signals.stopRequested() && !(loop.stopRequested && loop.stopRequested())) {
        const Time start = std::chrono::steady_clock::now();
        tick(server, start);
        sockets.flush();
        if (loop.onTick) loop.onTick(millisecondsSince(start));
        next = std::max(next + kServerTick, start - kMaxTicksBehind * kServerTick);
        context.restart();
        // Even if ticks take too long, read messages of clients for a while.
        context.run_until(std::max(next, std::chrono::steady_clock::now() + kLeastListening));
    }
    sockets.stopListening();
    const auto stopped = stop(server, "the server stops");
    sendGoodbye(context, sockets);
    return stopped;
}

}  // namespace terrane::net
