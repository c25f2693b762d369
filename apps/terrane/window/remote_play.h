// A game on a server: the connection, the server's world once a session shows it, and who else is there. Used
// on the thread of the session.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/terrane/client_packs.h"
#include "terrane/net/client_link.h"
#include "terrane/net/client_world.h"
#include "terrane/net/remote_session.h"

namespace terrane::app {

struct RemoteOptions {
    std::string server;         // HOST[:PORT]; empty: none
    std::string name;           // of the player
    std::string password;       // where the server wants one
    bool acceptsPacks = false;  // whatever content packs the world needs
    std::vector<pack::PackHash> acceptedPacks = {};
};

class RemotePlay {
  public:
    // Begins to connect. The player's key and the keys of known servers are in `dataFolder`.
    [[nodiscard]] static base::Result<std::unique_ptr<RemotePlay>> connect(
        const RemoteOptions& options, const std::filesystem::path& dataFolder);
    ~RemotePlay();  // says goodbye

    // Takes in what the server sent, and sends. Call each frame.
    void poll();
    net::ClientLink::Stage stage() const { return link_->stage(); }
    const std::string& reason() const { return link_->reason(); }
    std::string address() const { return textOf(link_->address()); }

    // Packs that the server has and the player did not accept: why it ended.
    const std::vector<net::PackOffer>& missingPacks() const { return packs_.missing; }
    // Of the server's world, once joined.
    const pack::Content& content() const { return content_; }
    const std::optional<net::WorldOffer>& offer() const { return offer_; }
    world::Pose start() const;
    // The session shows the server's world from here on; it outlives this.
    void begin(game::Session& session, net::RemoteStore& store);
    net::ClientWorld& world() { return *world_; }
    void askPlayers() { link_->send(net::AskPlayers{}); }

  private:
    struct Network;
    explicit RemotePlay(std::unique_ptr<Network> network);
    base::Result<std::vector<std::uint8_t>> fetchFirst(const net::WorldOffer& offer);
    base::Result<net::SampleDigests> prove(const net::WorldOffer& offer);
    base::Result<bool> trusts(const std::string& key) const;

    std::unique_ptr<Network> network_;
    ClientPacks packs_;
    pack::Content content_;
    std::filesystem::path knownServers_;  // file
    std::unique_ptr<net::ClientLink> link_;
    std::optional<net::WorldOffer> offer_;
    std::vector<net::ServerMessage> early_;  // before a session shows the world
    std::unique_ptr<net::ClientWorld> world_;
    net::ClientLink::Stage before_ = net::ClientLink::Stage::Connecting;
};

}  // namespace terrane::app
