#include "terrane/net/keys.h"

#include <sodium.h>

#include <cstdlib>
#include <system_error>

#include "terrane/base/files.h"

namespace terrane::net {
namespace {

const unsigned char* raw(ByteView bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
}
unsigned char* rawOf(std::span<std::byte> bytes) {
    return reinterpret_cast<unsigned char*>(bytes.data());
}

// Must run before any other function of the library. It fails only if the system has no random numbers.
void startSodium() {
    static const bool isStarted = sodium_init() >= 0;
    if (!isStarted) std::abort();
}

struct SecretKey {
    explicit SecretKey(const PlayerKey& key) {
        PublicKey publicKey;
        crypto_sign_seed_keypair(rawOf(publicKey), bytes.data(), raw(key.seed));
    }
    ~SecretKey() { sodium_memzero(bytes.data(), bytes.size()); }
    std::array<unsigned char, crypto_sign_SECRETKEYBYTES> bytes;
};

base::Result<PlayerKey> writeKey(const std::filesystem::path& file) {
    const PlayerKey key = newPlayerKey();
    std::array<char, 65> text{};
    sodium_bin2hex(text.data(), text.size(), raw(key.seed), key.seed.size());
    text[64] = '\n';
    TERRANE_TRY(base::writePrivateFile(file, {text.data(), text.size()}));
    return key;
}

}  // namespace

void fillRandom(std::span<std::byte> bytes) {
    startSodium();
    randombytes_buf(bytes.data(), bytes.size());
}

PlayerKey newPlayerKey() {
    std::array<std::byte, 32> seed;
    fillRandom(seed);
    return playerKeyFrom(seed);
}

PlayerKey playerKeyFrom(const std::array<std::byte, 32>& seed) {
    startSodium();
    PlayerKey key{seed, {}};
    std::array<unsigned char, crypto_sign_SECRETKEYBYTES> secret;
    crypto_sign_seed_keypair(rawOf(key.publicKey), secret.data(), raw(seed));
    sodium_memzero(secret.data(), secret.size());
    return key;
}

base::Result<PlayerKey> loadPlayerKey(const std::filesystem::path& file) {
    startSodium();
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
        std::filesystem::create_directories(file.parent_path(), error);
        return writeKey(file);
    }
    const auto text = TERRANE_TRY(base::readFile(file));
    std::array<std::byte, 32> seed;
    std::size_t length = 0;
    const char* end = nullptr;
    const bool isHex =
        sodium_hex2bin(rawOf(seed), seed.size(), text.data(), text.size(), nullptr, &length, &end) == 0;
    const bool isWhole =
        isHex && length == seed.size() &&
        std::string_view(end, text.data() + text.size()).find_first_not_of("\r\n ") == std::string_view::npos;
    if (isWhole) return playerKeyFrom(seed);
    return base::fail(base::ErrorCode::Damaged, "{}: not a player's key: expected 64 hexadecimal digits",
                      file.string());
}

Signature sign(const PlayerKey& key, ByteView text) {
    startSodium();
    const SecretKey secret(key);
    Signature signature;
    crypto_sign_detached(rawOf(signature), nullptr, raw(text), text.size(), secret.bytes.data());
    return signature;
}

bool isSignedBy(const PublicKey& key, ByteView text, const Signature& signature) {
    startSodium();
    return crypto_sign_verify_detached(raw(signature), raw(text), text.size(), raw(key)) == 0;
}

base::Result<std::string> passwordHash(const std::string& password) {
    startSodium();
    std::array<char, crypto_pwhash_STRBYTES> hash;
    if (crypto_pwhash_str(hash.data(), password.data(), password.size(), crypto_pwhash_OPSLIMIT_INTERACTIVE,
                          crypto_pwhash_MEMLIMIT_INTERACTIVE) == 0)
        return std::string(hash.data());
    return base::fail(base::ErrorCode::OutOfResources, "no memory for a password's hash");
}

bool fitsPassword(const std::string& hash, const std::string& password) {
    startSodium();
    return crypto_pwhash_str_verify(hash.c_str(), password.data(), password.size()) == 0;
}

}  // namespace terrane::net
