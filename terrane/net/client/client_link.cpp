#include "terrane/net/client/client_link.h"

#include <algorithm>
#include <utility>

#include "terrane/base/match.h"

namespace terrane::net {

Hello helloOf(const ClientIdentity& identity) {
    return {kMagic, kProtocolVersion, identity.program};
}

Login loginOf(const ClientIdentity& identity, const Greeting& greeting, ByteView channel) {
    const Bytes text = loginText(channel, greeting.nonce, identity.name);
    return {identity.name, identity.key.publicKey, sign(identity.key, text),
            greeting.needsPassword ? identity.password : std::string()};
}

std::optional<AskPack> nextPart(const PackFetch& fetch) {
    if (fetch.missing.empty()) return std::nullopt;
    return AskPack{fetch.missing.back(), static_cast<std::uint32_t>(fetch.archive.size())};
}

base::Result<bool> takePart(PackFetch& fetch, const PackPart& part) {
    const std::optional<AskPack> asked = nextPart(fetch);
    if (!asked || part.number != asked->number || part.offset != asked->offset)
        return base::fail("the server sent a part of a pack that was not asked for");
    const std::size_t size = fetch.offer.packs[part.number].bytes;
    if (part.data.empty() || fetch.archive.size() + part.data.size() > size)
        return base::fail("the server sent a different pack than it offered");
    store::append(fetch.archive, part.data);
    return fetch.archive.size() == size;
}

namespace {

// Delay between attempts: 0.5 s, doubled each time.
constexpr std::chrono::milliseconds kFirstWait{500}, kLongestWait{8000};
constexpr std::chrono::seconds kLoginTime{15};
// The server sends a message at least every five seconds.
constexpr std::chrono::seconds kSilence{20};

// Whether the blocks of a message, if it has any, are in the world's heights.
template <class Message>
bool fitsWorld(const Message& message, world::Heights heights) {
    if constexpr (requires { message.blocks; })
        return isWithin(message.blocks, heights);
    else
        return true;
}

}  // namespace

ClientLink::ClientLink(boost::asio::io_context& context, ServerAddress address, ClientIdentity identity,
                       LinkEvents events)
    : context_(context),
      address_(std::move(address)),
      identity_(std::move(identity)),
      events_(std::move(events)) {
    connect();
}

void ClientLink::connect() {
    stage_ = Stage::Connecting;
    fetch_.reset();
    hasOffer_ = hasProved_ = false;
    triedAt_ = now_;
    SocketEvents events;
    events.opened = [this](const Bytes& channel, const std::string& serverKey) {
        if (stage_ == Stage::Ended) return socket_->close();  // leave() while connecting
        const base::Result<bool> trusted = isTrusted(serverKey);
        if (!trusted) return end(trusted.error().message);
        if (!*trusted && isToldKey_) return onCut("another server answers");
        if (!*trusted)
            return end(textOf(address_) + ": the server's key has changed: it may be another server");
        channel_ = channel;
        say(helloOf(identity_));
    };
    events.message = [this](ByteView bytes) { onMessage(bytes); };
    events.closed = [this](const std::string& reason) { onCut(reason); };
    formerReceived_ = receivedBytes();
    formerSent_ = sentBytes();
    socket_.emplace(context_, address_, std::move(events));
}

void ClientLink::update(std::chrono::steady_clock::time_point now) {
    const bool isFirst = now_ == std::chrono::steady_clock::time_point();
    now_ = now;
    if (isFirst) triedAt_ = now;
    if (stage_ == Stage::Waiting && now >= tryAt_) connect();
    if (stage_ == Stage::Connecting && now - triedAt_ > kLoginTime) onCut("the server does not answer");
    if (stage_ == Stage::Joined && now - heardAt_ > kSilence)
        onCut("no message from the server for too long");
}

void ClientLink::send(const ClientMessage& message) {
    if (stage_ == Stage::Joined) say(message);
}

void ClientLink::leave() {
    send(Leave{});
    if (stage_ == Stage::Ended) return;
    reason_.clear();
    stage_ = Stage::Ended;
}

void ClientLink::say(const ClientMessage& message) {
    socket_->send(encode(message));
}

void ClientLink::onMessage(ByteView bytes) {
    if (stage_ == Stage::Ended) return;
    heardAt_ = now_;
    const auto message = decodeServerMessage(bytes);
    if (!message) return end("the server sent an invalid message: " + message.error().message);
    std::visit(base::Match{
                   [this](const Refused& refused) { onRefused(refused); },
                   [this](const Greeting& greeting) { say(loginOf(identity_, greeting, channel_)); },
                   [this](const WorldOffer& offer) { onOffer(offer); },
                   [this](const PackPart& part) { onPackPart(part); },
                   [this](const Joined& joined) { onJoined(joined); },
                   [this](const Ping& ping) { say(Pong{ping.time}); },
                   [this](const Servers& servers) { learnServers(servers); },
                   [&](const OfWorld auto& ofWorld) {
                       if (!fitsWorld(ofWorld, heights_))
                           return end("the server sent blocks above or below its world");
                       if (stage_ == Stage::Joined) events_.message(*message);
                   },
               },
               *message);
}

void ClientLink::onJoined(const Joined& joined) {
    if (!hasProved_) return end("the server let the player in before it offered its world");
    stage_ = Stage::Joined;
    wasJoined_ = true;
    cuts_ = 0;
    events_.message(joined);
}

void ClientLink::onOffer(const WorldOffer& offer) {
    if (std::exchange(hasOffer_, true)) return end("the server offered its world twice");
    heights_ = offer.world.identity.heights;
    fetch_ = PackFetch{offer, {}, {}};
    if (events_.missingPacks) {
        auto missing = events_.missingPacks(offer);
        if (!missing) return end(missing.error().message);
        fetch_->missing = std::move(*missing);
    }
    fetchOrProve();
}

void ClientLink::onPackPart(const PackPart& part) {
    triedAt_ = now_;
    if (!fetch_) return end("the server sent a part of a pack that was not asked for");
    const auto isWhole = takePart(*fetch_, part);
    if (!isWhole) return end(isWhole.error().message);
    if (*isWhole) {
        const Bytes archive = std::exchange(fetch_->archive, {});
        fetch_->missing.pop_back();
        const auto taken = events_.packArrived(fetch_->offer.packs[part.number], archive);
        if (!taken) return end(taken.error().message);
    }
    fetchOrProve();
}

void ClientLink::fetchOrProve() {
    if (const auto ask = nextPart(*fetch_)) return say(*ask);
    const WorldOffer offer = std::move(fetch_->offer);
    fetch_.reset();
    const auto digests = events_.prove(offer);
    hasProved_ = true;
    digests ? say(Proof{*digests}) : end(digests.error().message);
}

// A server that stops may start again: a client that was in its world waits for that.
void ClientLink::onRefused(const Refused& refused) {
    if (wasJoined_ && isWorthReturning(refused.why)) return onCut(refused.reason);
    end(refused.reason);
}

void ClientLink::onCut(const std::string& reason) {
    if (stage_ == Stage::Ended) return;
    if (!wasJoined_) return end(textOf(address_) + ": " + reason);
    socket_->close();
    reason_ = reason;
    stage_ = Stage::Waiting;
    const auto wait = std::min(kFirstWait * (1 << std::min(cuts_, 4)), kLongestWait);
    // Random jitter, so that the clients of a stopped server do not reconnect all at once.
    std::uint8_t share = 0;
    fillRandom(std::as_writable_bytes(std::span(&share, 1)));
    tryAt_ = now_ + wait + wait * share / 256;
    ++cuts_;
    goToNext();
}

// A key announced by a server is compared directly; `trusts` is not called.
base::Result<bool> ClientLink::isTrusted(const std::string& serverKey) {
    if (isToldKey_) return key_ == serverKey;
    auto trusted = events_.trusts(serverKey);
    if (trusted && *trusted) key_ = serverKey;
    return trusted;
}

void ClientLink::learnServers(const Servers& servers) {
    others_.clear();
    for (const Servers::Place& place : servers.places)
        if (auto address = serverAddress(place.address); address && !place.key.empty())
            others_.push_back({*address, place.key});
}

// Round robin; the current server goes to the end.
void ClientLink::goToNext() {
    if (others_.empty()) return;
    OtherServer next = std::move(others_.front());
    others_.erase(others_.begin());
    others_.push_back({std::exchange(address_, next.address), std::exchange(key_, next.key)});
    isToldKey_ = true;
}

void ClientLink::end(const std::string& reason) {
    socket_->close();
    reason_ = reason;
    stage_ = Stage::Ended;
}

std::uint64_t ClientLink::receivedBytes() const {
    return formerReceived_ + (socket_ ? socket_->receivedBytes() : 0);
}
std::uint64_t ClientLink::sentBytes() const {
    return formerSent_ + (socket_ ? socket_->sentBytes() : 0);
}

}  // namespace terrane::net
