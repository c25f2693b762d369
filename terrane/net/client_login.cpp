#include "terrane/net/client_login.h"

namespace terrane::net {

Hello helloOf(const ClientIdentity& identity) {
    return {kMagic, kProtocolVersion, identity.program};
}

Login loginOf(const ClientIdentity& identity, const Greeting& greeting, ByteView channel) {
    const Bytes text = loginText(channel, greeting.nonce, identity.name);
    return {identity.name, identity.key.publicKey, sign(identity.key, text),
            greeting.needsPassword ? identity.password : std::string()};
}

}  // namespace terrane::net
