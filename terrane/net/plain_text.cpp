#include "terrane/net/plain_text.h"

#include "terrane/base/printable.h"

namespace terrane::net {

bool isPlainText(std::string_view text) {
    return base::printable(text) == text;
}

std::string plainText(std::string_view text, std::size_t maxBytes) {
    std::string line = base::printable(text);
    if (line.size() <= maxBytes) return line;
    // Cut at a character boundary.
    std::size_t end = maxBytes;
    while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0) == 0x80) --end;
    line.resize(end);
    return line;
}

}  // namespace terrane::net
