// TLS 1.3 for servers and clients, through OpenSSL: connection contexts, and the server's key, which clients
// remember (docs/protocol.md). On one thread.
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <filesystem>
#include <string>

#include "terrane/base/result.h"
#include "terrane/net/wire.h"

namespace terrane::net {

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
