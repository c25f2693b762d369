// TOML, the language of settings, content packs and scripts. Any thread.
#pragma once

#include <toml++/toml.h>

#include <string_view>

#include "terrane/base/result.h"

namespace terrane::base {

// Each part is a table in the one before it.
constexpr int kMaxKeyParts = 16;

// Parses the text of a file. `name`: of the file, for the error, which is one line: "NAME:3: syntax: …".
// Refuses keys of more than kMaxKeyParts parts: the library goes down into their tables by recursion, and
// 60,000 parts overflow the stack. It limits the nesting of arrays and inline tables itself.
[[nodiscard]] Result<toml::table> parseToml(std::string_view text, std::string_view name);

}  // namespace terrane::base
