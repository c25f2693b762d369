// Player keys (Ed25519) and password hashes (Argon2id), through libsodium. Any thread.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "terrane/base/result.h"
#include "terrane/net/wire.h"

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

}  // namespace terrane::net
