#include "terrane/net/wire/security.h"

#include <fmt/ranges.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <sodium.h>

#include <cstdlib>
#include <memory>
#include <sstream>
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

base::Result<bool> isKnownOrNew(const std::filesystem::path& file, const std::string& server,
                                const std::string& key) {
    std::error_code ignored;
    std::string text;
    if (std::filesystem::exists(file, ignored)) {
        auto read = TERRANE_TRY(base::readFile(file));
        text = std::move(read);
    }
    std::istringstream lines(text);
    std::string name, known;
    while (lines >> name >> known)
        if (name == server) return known == key;
    std::filesystem::create_directories(file.parent_path(), ignored);
    if (!text.empty() && text.back() != '\n') text += '\n';
    TERRANE_TRY(base::writeFile(file, text + server + ' ' + key + '\n'));
    return true;
}

namespace {

namespace ssl = boost::asio::ssl;

template <auto free>
struct Free {
    void operator()(auto* pointer) const { free(pointer); }
};
using Key = std::unique_ptr<EVP_PKEY, Free<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Free<X509_free>>;
using Bio = std::unique_ptr<BIO, Free<BIO_free>>;

constexpr long kYears = 100;  // expiry is not checked: clients remember the key

Certificate certificateFor(EVP_PKEY* key) {
    Certificate certificate(X509_new());
    X509_set_version(certificate.get(), 2);
    ASN1_INTEGER_set(X509_get_serialNumber(certificate.get()), 1);
    X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -24 * 3600);
    X509_time_adj_ex(X509_getm_notAfter(certificate.get()), static_cast<int>(kYears * 365), 0, nullptr);
    X509_set_pubkey(certificate.get(), key);
    X509_NAME* name = X509_get_subject_name(certificate.get());
    const auto* text = reinterpret_cast<const unsigned char*>("terrane server");
    X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, text, -1, -1, 0);
    X509_set_issuer_name(certificate.get(), name);
    const bool isSigned = X509_sign(certificate.get(), key, EVP_sha256()) > 0;
    return isSigned ? std::move(certificate) : nullptr;
}

// Creates a file with key and certificate, never readable by others.
base::Result<void> makeKeyFile(const std::filesystem::path& file) {
    const Key key(EVP_PKEY_Q_keygen(nullptr, nullptr, "EC", "P-256"));
    const Certificate certificate = key ? certificateFor(key.get()) : nullptr;
    if (!certificate) return base::fail("{}: no key can be made", file.string());
    const Bio text(BIO_new(BIO_s_mem()));
    const bool isMade =
        text && PEM_write_bio_PrivateKey(text.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) &&
        PEM_write_bio_X509(text.get(), certificate.get());
    if (!isMade) return base::fail("{}: no key can be made", file.string());
    char* bytes = nullptr;
    const long count = BIO_get_mem_data(text.get(), &bytes);
    return base::writePrivateFile(file, {bytes, static_cast<std::size_t>(count)});
}

std::string keyOf(X509* certificate) {
    if (!certificate) return {};
    unsigned char* der = nullptr;
    const int length = i2d_X509_PUBKEY(X509_get_X509_PUBKEY(certificate), &der);
    if (length <= 0) return {};
    std::array<unsigned char, 32> hash;
    const bool isHashed =
        EVP_Digest(der, static_cast<std::size_t>(length), hash.data(), nullptr, EVP_sha256(), nullptr);
    OPENSSL_free(der);
    return isHashed ? fmt::format("{:02x}", fmt::join(hash, "")) : std::string();
}

// Many connections are idle: release their buffers meanwhile.
void prepareContext(ssl::context& context) {
    SSL_CTX_set_min_proto_version(context.native_handle(), TLS1_3_VERSION);
    SSL_CTX_set_mode(context.native_handle(), SSL_MODE_RELEASE_BUFFERS);
    SSL_CTX_set_session_cache_mode(context.native_handle(), SSL_SESS_CACHE_OFF);
    SSL_CTX_set_num_tickets(context.native_handle(), 0);
}

}  // namespace

base::Result<ssl::context> serverContext(const std::filesystem::path& keyFile) {
    std::error_code error;
    if (!std::filesystem::exists(keyFile, error)) TERRANE_TRY(makeKeyFile(keyFile));
    if (!std::filesystem::is_regular_file(keyFile, error))  // OpenSSL would wait for the writer of a pipe
        return base::fail("{}: not a regular file", keyFile.string());
    ssl::context context(ssl::context::tls_server);
    prepareContext(context);
    boost::system::error_code failed;
    context.use_certificate_chain_file(keyFile.string(), failed);
    if (!failed) context.use_private_key_file(keyFile.string(), ssl::context::pem, failed);
    if (failed)
        return base::fail(base::ErrorCode::Damaged, "{}: not a key and certificate of a server: {}",
                          keyFile.string(), failed.message());
    return context;
}

ssl::context clientContext() {
    ssl::context context(ssl::context::tls_client);
    prepareContext(context);
    context.set_verify_mode(ssl::verify_none);
    return context;
}

std::string peerKey(SSL* connection) {
    const Certificate certificate(SSL_get1_peer_certificate(connection));
    return keyOf(certificate.get());
}

std::string ownKey(SSL_CTX* context) {
    return keyOf(SSL_CTX_get0_certificate(context));
}

Bytes channelOf(SSL* connection) {
    constexpr std::string_view kLabel = "EXPORTER-Channel-Binding";
    Bytes channel(32);
    const int done = SSL_export_keying_material(connection, reinterpret_cast<unsigned char*>(channel.data()),
                                                channel.size(), kLabel.data(), kLabel.size(), nullptr, 0, 1);
    return done == 1 ? channel : Bytes();
}

}  // namespace terrane::net
