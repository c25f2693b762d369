// A client's link to a server: connects, logs in, and reconnects after a lost connection, also to another
// server of the same world if the server announced one. The caller handles the world: it answers WorldOffer,
// and gets all messages from Joined on. On the thread that runs the context.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "terrane/net/client/client_socket.h"
#include "terrane/net/wire/client_message.h"
#include "terrane/net/wire/security.h"
#include "terrane/net/wire/server_message.h"

namespace terrane::net {

// The client's side of the login (docs/protocol.md), without sockets: builds the answers to the server's
// messages. Plain values and functions; any thread.
// The identity that a client logs in with.
struct ClientIdentity {
    std::string name;
    PlayerKey key;
    std::string password;  // empty: none
    std::string program;   // and its version
};

Hello helloOf(const ClientIdentity& identity);
// Answers a Greeting. `channel`: the connection's keying material.
Login loginOf(const ClientIdentity& identity, const Greeting& greeting, ByteView channel);

// Whether reconnecting soon may succeed: the refusal is not about the player or its program.
constexpr bool isWorthReturning(Refusal why) {
    return why == Refusal::Stopping || why == Refusal::Silent || why == Refusal::TooSlow ||
           why == Refusal::Full;
}

// Download of missing content packs, part by part, between WorldOffer and Proof. Plain data; on the link's
// thread.
struct PackFetch {
    WorldOffer offer;
    std::vector<std::uint8_t> missing;  // indices into offer.packs, the next one last
    Bytes archive;                      // bytes received of the next one
};

// The request for the next part; no value once all packs are complete.
std::optional<AskPack> nextPart(const PackFetch& fetch);

// Appends the requested part. Fails for another part, or more bytes than the offer announced. Returns true
// once the archive is complete: then the caller takes it and removes the pack from `missing`.
[[nodiscard]] base::Result<bool> takePart(PackFetch& fetch, const PackPart& part);

struct LinkEvents {
    // Called before anything is sent. Returns whether the server has its known key, or none was known
    // (security.h). False or an error ends the link.
    std::function<base::Result<bool>(const std::string& serverKey)> trusts;
    // Returns the digests of the sample chunks, or why this program cannot play there.
    std::function<base::Result<SampleDigests>(const WorldOffer&)> prove;
    std::function<void(const ServerMessage&)> message;
    // Returns the packs to download before Proof, as indices into `packs` of the offer, or why this program
    // cannot play there. If the function is empty, no packs are downloaded.
    std::function<base::Result<std::vector<std::uint8_t>>(const WorldOffer&)> missingPacks = {};
    // Called with each downloaded pack.
    std::function<base::Result<void>(const PackOffer&, const Bytes& archive)> packArrived = {};
};

class ClientLink {
  public:
    enum class Stage : std::uint8_t {
        Connecting,  // or logging in
        Joined,
        Waiting,  // for the next attempt, after a lost connection
        Ended,    // will not reconnect: reason()
    };

    ClientLink(boost::asio::io_context& context, ServerAddress address, ClientIdentity identity,
               LinkEvents events);

    // Reconnects when an attempt is due. Call often, with the context run between calls.
    void update(std::chrono::steady_clock::time_point now);
    // Drops the message while no world is joined.
    void send(const ClientMessage& message);
    // Sends Leave and ends; queued bytes are sent while the context runs on.
    void leave();

    Stage stage() const { return stage_; }
    // Why the last connection ended; empty if none did.
    const std::string& reason() const { return reason_; }
    const ServerAddress& address() const { return address_; }
    // Bytes of all connections so far.
    std::uint64_t receivedBytes() const;
    std::uint64_t sentBytes() const;

  private:
    void connect();
    void onMessage(ByteView bytes);
    void onJoined(const Joined& joined);
    void onOffer(const WorldOffer& offer);
    void onPackPart(const PackPart& part);
    void fetchOrProve();
    void onRefused(const Refused& refused);
    void onCut(const std::string& reason);
    void learnServers(const Servers& servers);
    void goToNext();
    base::Result<bool> isTrusted(const std::string& serverKey);
    void end(const std::string& reason);
    void say(const ClientMessage& message);

    boost::asio::io_context& context_;
    ServerAddress address_;
    ClientIdentity identity_;
    LinkEvents events_;
    // Other servers of the world, with their keys, as announced by a trusted one.
    struct OtherServer {
        ServerAddress address;
        std::string key;
    };
    std::vector<OtherServer> others_;
    std::string key_;         // of the server at address_
    bool isToldKey_ = false;  // key_ was announced by another server
    std::optional<ClientSocket> socket_;
    Bytes channel_;
    std::optional<PackFetch> fetch_;             // from WorldOffer to Proof
    bool hasOffer_ = false, hasProved_ = false;  // of this connection
    world::Heights heights_;                     // of the offered world
    Stage stage_ = Stage::Waiting;
    std::string reason_;
    std::chrono::steady_clock::time_point now_{}, tryAt_{}, triedAt_{}, heardAt_{};
    int cuts_ = 0;  // since the last Joined
    bool wasJoined_ = false;
    std::uint64_t formerReceived_ = 0, formerSent_ = 0;
};

}  // namespace terrane::net
