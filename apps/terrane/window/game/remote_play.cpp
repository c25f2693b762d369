#include "apps/terrane/window/game/remote_play.h"

#include <boost/asio/io_context.hpp>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/net/wire/security.h"

namespace terrane::app {

struct RemotePlay::Network {
    boost::asio::io_context context;
};

RemotePlay::RemotePlay(std::unique_ptr<Network> network) : network_(std::move(network)) {}

RemotePlay::~RemotePlay() {
    world_.reset();
    link_->leave();
    network_->context.restart();
    network_->context.run_for(std::chrono::milliseconds(100));
}

base::Result<std::unique_ptr<RemotePlay>> RemotePlay::connect(const RemoteOptions& options,
                                                              const std::filesystem::path& dataFolder) {
    auto address = TERRANE_TRY(net::serverAddress(options.server));
    if (!net::isName(options.name))
        return base::fail(base::ErrorCode::BadInput, "--name {}: {}", options.name, net::nameRule());
    auto key = TERRANE_TRY(net::loadPlayerKey(dataFolder / "player.key"));
    std::unique_ptr<RemotePlay> play(new RemotePlay(std::make_unique<Network>()));
    play->packs_.cache = net::packCacheFolder();
    play->packs_.acceptsAll = options.acceptsPacks;
    play->packs_.accepted = options.acceptedPacks;
    play->knownServers_ = dataFolder / "known_servers.txt";
    RemotePlay& self = *play;
    play->link_ = std::make_unique<net::ClientLink>(
        play->network_->context, address,
        net::ClientIdentity{options.name, key, options.password, fmt::format("terrane {}", TERRANE_VERSION)},
        net::LinkEvents{[&self](const std::string& serverKey) { return self.trusts(serverKey); },
                        [&self](const net::WorldOffer& offer) { return self.prove(offer); },
                        [&self](const net::ServerMessage& message) {
                            if (self.world_)
                                self.world_->onMessage(message);
                            else
                                self.early_.push_back(message);
                        },
                        [&self](const net::WorldOffer& offer) { return self.fetchFirst(offer); },
                        [&self](const net::PackOffer& offer, const net::Bytes& archive) {
                            return net::takePack(self.packs_, offer, archive);
                        }});
    return play;
}

base::Result<bool> RemotePlay::trusts(const std::string& key) const {
    return net::isKnownOrNew(knownServers_, textOf(link_->address()), key);
}

base::Result<std::vector<std::uint8_t>> RemotePlay::fetchFirst(const net::WorldOffer& offer) {
    if (offer_ && offer.packs != offer_->packs)
        return base::fail("the server has other content packs than before: join it again");
    return net::missingPacks(packs_, offer);
}

// After a reconnect the session continues, so the server must still have the same world.
base::Result<net::SampleDigests> RemotePlay::prove(const net::WorldOffer& offer) {
    if (offer_ && !(offer.world == offer_->world && offer.packs == offer_->packs))
        return base::fail("the server has another world than before: join it again");
    if (!offer_) {
        auto content = TERRANE_TRY(net::contentOf(packs_, offer));
        content_ = std::move(content);
    }
    const auto generator = TERRANE_TRY(net::offeredGenerator(offer, *content_.blocks, content_.generators));
    offer_ = offer;
    return net::sampleDigests(generator, offer.samples);
}

world::Pose RemotePlay::start() const {
    for (const net::ServerMessage& message : early_)
        if (const auto* joined = std::get_if<net::Joined>(&message)) return net::poseOf(joined->pose);
    return {};
}

void RemotePlay::begin(game::Session& session, net::RemoteStore& store) {
    world_ = std::make_unique<net::ClientWorld>(
        session, store, [this](const net::ClientMessage& message) { link_->send(message); });
    for (const net::ServerMessage& message : std::exchange(early_, {})) world_->onMessage(message);
}

void RemotePlay::poll() {
    link_->update(std::chrono::steady_clock::now());
    network_->context.restart();
    network_->context.poll();
    const bool isCut = before_ == net::ClientLink::Stage::Joined && link_->stage() != before_;
    if (isCut && world_) world_->onCut();
    before_ = link_->stage();
}

}  // namespace terrane::app
