// Converts integer literals to bytes.
#pragma once

#include <initializer_list>

#include "terrane/net/wire/wire.h"

namespace terrane::net {

inline Bytes bytesOf(std::initializer_list<int> values) {
    Bytes bytes;
    for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

}  // namespace terrane::net
