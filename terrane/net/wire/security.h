// Player keys (Ed25519) and password hashes (Argon2id), through libsodium. Any thread.
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "terrane/base/result.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net {

using PublicKey = std::array<std::byte, 32>;
using Signature = std::array<std::byte, 64>;

// A player's key pair. Whoever has the seed can act as the player.
struct PlayerKey {
    std::array<std::byte, 32> seed{};
    PublicKey publicKey{};
};

// Fills `bytes` with cryptographically secure random values.
void fillRandom(std::span<std::byte> bytes);

PlayerKey newPlayerKey();
PlayerKey playerKeyFrom(const std::array<std::byte, 32>& seed);
// Loads the seed from a file of 64 hexadecimal digits that only its owner can read. Creates the file if it
// does not exist.
[[nodiscard]] base::Result<PlayerKey> loadPlayerKey(const std::filesystem::path& file);

Signature sign(const PlayerKey& key, ByteView text);
bool isSignedBy(const PublicKey& key, ByteView text, const Signature& signature);

// The hash to store instead of the password. Takes about 0.1 s and 64 MiB, as does each check, which slows
// down guessing from a stolen hash.
[[nodiscard]] base::Result<std::string> passwordHash(const std::string& password);
bool fitsPassword(const std::string& hash, const std::string& password);

// The keys of servers that a player visited, one "HOST:PORT KEY" per line. A server is trusted on first use;
// later it must have the same key. Any thread.
// Whether the server has its known key. An unknown server's key is added to the file.
[[nodiscard]] base::Result<bool> isKnownOrNew(const std::filesystem::path& file, const std::string& server,
                                              const std::string& key);

// TLS 1.3 for servers and clients, through OpenSSL: connection contexts, and the server's key, which clients
// remember (docs/protocol.md). On one thread.
// A server's context. Its key and certificate are in a PEM file that only its owner can read; the file is
// created if needed.
[[nodiscard]] base::Result<boost::asio::ssl::context> serverContext(const std::filesystem::path& keyFile);
// A client's context. It accepts any certificate: the caller must compare the key.
boost::asio::ssl::context clientContext();

// SHA-256 of the peer's public key, 64 hexadecimal digits; empty without a certificate.
std::string peerKey(SSL* connection);
// The same hash of a server's own key.
std::string ownKey(SSL_CTX* context);

// The connection's exported keying material (RFC 9266): equal at both ends of one connection only.
Bytes channelOf(SSL* connection);

}  // namespace terrane::net
