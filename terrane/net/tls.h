// TLS 1.3 for servers and clients: a server's key, which clients remember (docs/protocol.md), and contexts
// for connections, through OpenSSL. On one thread.
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <filesystem>
#include <string>

#include "terrane/base/result.h"
#include "terrane/net/wire.h"

namespace terrane::net {

// A server's context. Its key and certificate are in a file (PEM) that its owner alone can read, made where
// it is not there.
[[nodiscard]] base::Result<boost::asio::ssl::context> serverContext(const std::filesystem::path& keyFile);
// A client's. It believes any certificate: whoever connects compares the key.
boost::asio::ssl::context clientContext();

// SHA-256 of the public key of the peer, 64 hexadecimal digits; empty where it showed none.
std::string peerKey(SSL* connection);
// The same of a server's own key.
std::string ownKey(SSL_CTX* context);

// The connection's exported keying material (RFC 9266): equal at both ends of one connection alone.
Bytes channelOf(SSL* connection);

}  // namespace terrane::net
