// A client's link to a server: connects, logs in, comes back by itself after a cut, to another server of the
// same world where the server told of one. What is done with the world is the caller's: it answers
// WorldOffer, and gets all messages from Joined on. On the thread that runs the context.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "terrane/net/client_login.h"
#include "terrane/net/client_socket.h"
#include "terrane/net/pack_fetch.h"

namespace terrane::net {

struct LinkEvents {
    // The server's key, before anything is said to it: whether it is the one that it had before. The link
    // ends where that cannot be known.
    std::function<base::Result<bool>(const std::string& serverKey)> trusts;
    // The digests of the sample chunks, or why this program cannot play there.
    std::function<base::Result<SampleDigests>(const WorldOffer&)> prove;
    std::function<void(const ServerMessage&)> message;
    // The numbers in `packs` of the offer of those that are to be fetched first, or why this program cannot
    // play there. An empty function: none.
    std::function<base::Result<std::vector<std::uint8_t>>(const WorldOffer&)> missingPacks = {};
    // One of them, as the server sent it.
    std::function<base::Result<void>(const PackOffer&, const Bytes& archive)> packArrived = {};
};

class ClientLink {
  public:
    enum class Stage : std::uint8_t {
        Connecting,  // or logging in
        Joined,
        Waiting,  // for the next attempt, after a cut
        Ended,    // it will not come back: reason()
    };

    ClientLink(boost::asio::io_context& context, ServerAddress address, ClientIdentity identity,
               LinkEvents events);

    // Attempts that are due. Call often, with the context run between calls.
    void update(std::chrono::steady_clock::time_point now);
    // Nothing while no world is joined.
    void send(const ClientMessage& message);
    // Says goodbye and ends; what is on its way is sent while the context runs on.
    void leave();

    Stage stage() const { return stage_; }
    // Why the last connection ended; empty where none did.
    const std::string& reason() const { return reason_; }
    const ServerAddress& address() const { return address_; }
    // Of all connections so far.
    std::uint64_t receivedBytes() const;
    std::uint64_t sentBytes() const;

  private:
    void connect();
    void onMessage(ByteView bytes);
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
    // Servers of the world that a trusted one told of, with their keys; the own one is not among them.
    struct OtherServer {
        ServerAddress address;
        std::string key;
    };
    std::vector<OtherServer> others_;
    std::string key_;         // of this server
    bool isToldKey_ = false;  // a server told it
    std::optional<ClientSocket> socket_;
    Bytes channel_;
    std::optional<PackFetch> fetch_;             // from WorldOffer to Proof
    bool hasOffer_ = false, hasProved_ = false;  // of this connection
    Stage stage_ = Stage::Waiting;
    std::string reason_;
    std::chrono::steady_clock::time_point now_{}, tryAt_{}, triedAt_{}, heardAt_{};
    int cuts_ = 0;  // since the last Joined
    bool wasJoined_ = false;
    std::uint64_t formerReceived_ = 0, formerSent_ = 0;
};

}  // namespace terrane::net
