// Decodes UTF-8 (the Unicode standard, section 3.9, table 3-7: overlong forms, surrogates and codes beyond
// U+10FFFF are invalid). Any thread may call.
#pragma once

#include <cstddef>
#include <string_view>

namespace terrane::base {

struct Character {
    char32_t code = 0;
    std::size_t bytes = 0;  // 0: the text does not begin with valid UTF-8
};

// The first character of a text that is not empty.
[[nodiscard]] Character firstCharacter(std::string_view text);

[[nodiscard]] bool isUtf8(std::string_view text);

}  // namespace terrane::base
