// Text that players and servers send each other: names, chat, reasons. Pure functions, for any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace terrane::net {

// Whether the text is UTF-8 without characters that end or reorder lines (base/printable.h).
bool isPlainText(std::string_view text);
// Escapes any text so that isPlainText() holds, and cuts it to `maxBytes` at a character.
std::string plainText(std::string_view text, std::size_t maxBytes);

}  // namespace terrane::net
