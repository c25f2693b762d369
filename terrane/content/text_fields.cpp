#include "terrane/content/text_fields.h"

#include <algorithm>

namespace terrane::content {
namespace {

// Length of the field of printf that begins with the percent sign at `at`.
std::size_t printfLength(std::string_view text, std::size_t at) {
    constexpr std::string_view kBeforeType = "-+ #0123456789.*hlLqjzt";
    const std::size_t type = text.find_first_not_of(kBeforeType, at + 1);
    return std::min(type, text.size() - 1) - at + 1;
}

// Length of the field of fmt that begins with the brace at `at`.
std::size_t braceLength(std::string_view text, std::size_t at) {
    const bool isDoubled = at + 1 < text.size() && text[at + 1] == text[at];
    if (isDoubled) return 2;
    const std::size_t end = text.find('}', at);
    return text[at] == '{' && end != text.npos ? end - at + 1 : 1;
}

}  // namespace

std::vector<std::string> textFields(std::string_view text) {
    std::vector<std::string> fields;
    std::size_t at = text.find_first_of("%{}");
    while (at != text.npos) {
        const std::size_t length = text[at] == '%' ? printfLength(text, at) : braceLength(text, at);
        fields.emplace_back(text.substr(at, length));
        at = text.find_first_of("%{}", at + length);
    }
    return fields;
}

}  // namespace terrane::content
