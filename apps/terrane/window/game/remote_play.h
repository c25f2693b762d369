// A game on a server: the connection, and the server's world once a session shows it. Used on the thread of
// the session.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "terrane/net/client/client_link.h"
#include "terrane/net/client/client_packs.h"
#include "terrane/net/client/client_world.h"
#include "terrane/net/client/remote_session.h"

namespace terrane::app {

struct RemoteOptions {
    std::string server;         // HOST[:PORT]; empty: none
    std::string name;           // of the player
    std::string password;       // if the server requires one
    bool acceptsPacks = false;  // accepts all content packs of the world
    std::vector<pack::PackHash> acceptedPacks = {};
};

class RemotePlay {
  public:
    // Starts to connect. `dataFolder` has the player's key and the keys of known servers.
    [[nodiscard]] static base::Result<std::unique_ptr<RemotePlay>> connect(
        const RemoteOptions& options, const std::filesystem::path& dataFolder);
    ~RemotePlay();  // says goodbye

    // Receives and sends messages. Call each frame.
    void poll();
    net::ClientLink::Stage stage() const { return link_->stage(); }
    const std::string& reason() const { return link_->reason(); }
    std::string address() const { return textOf(link_->address()); }

    // Packs that the player has to accept: the reason why the connection ended.
    const std::vector<net::PackOffer>& missingPacks() const { return packs_.missing; }
    // Content of the server's world, after joining.
    const pack::Content& content() const { return content_; }
    const std::optional<net::WorldOffer>& offer() const { return offer_; }
    world::Pose start() const;
    // From here on the session shows the server's world; it outlives this.
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
    net::ClientPacks packs_;
    pack::Content content_;
    std::filesystem::path knownServers_;  // file
    std::unique_ptr<net::ClientLink> link_;
    std::optional<net::WorldOffer> offer_;
    std::vector<net::ServerMessage> early_;  // received before begin()
    std::unique_ptr<net::ClientWorld> world_;
    net::ClientLink::Stage before_ = net::ClientLink::Stage::Connecting;
};

}  // namespace terrane::app
