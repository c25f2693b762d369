// Asks the player whether a server may send the content packs of its world. Immediate mode.
#pragma once

#include <span>
#include <string>

#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/text.h"
#include "terrane/net/server_message.h"

namespace terrane::app {

enum class PackAnswer : std::uint8_t { None, Accept, Refuse };

PackAnswer drawPackDialog(const Screen& screen, const Texts& tr, const std::string& server,
                          std::span<const net::PackOffer> packs);

}  // namespace terrane::app
