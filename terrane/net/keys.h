// Keys by which players are known (Ed25519) and passwords of servers (Argon2id), through libsodium. Any
// thread.
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

// A player's own: who has the seed is the player.
struct PlayerKey {
    std::array<std::byte, 32> seed{};
    PublicKey publicKey{};
};

// Bytes that nobody can guess.
void fillRandom(std::span<std::byte> bytes);

PlayerKey newPlayerKey();
PlayerKey playerKeyFrom(const std::array<std::byte, 32>& seed);
// A file with the seed as 64 hexadecimal digits, which its owner alone can read. Made where it is not there.
[[nodiscard]] base::Result<PlayerKey> loadPlayerKey(const std::filesystem::path& file);

Signature sign(const PlayerKey& key, ByteView text);
bool isSignedBy(const PublicKey& key, ByteView text, const Signature& signature);

// To be kept in place of the password. Takes about 0.1 s and 64 MiB, as does each check: who finds the hash
// cannot try many.
[[nodiscard]] base::Result<std::string> passwordHash(const std::string& password);
bool fitsPassword(const std::string& hash, const std::string& password);

}  // namespace terrane::net
