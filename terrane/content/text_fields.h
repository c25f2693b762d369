// The places of a text where values are put in: of printf ("%d") and of fmt ("{:.1f}").
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace terrane::content {

// In the order of the text. "%%", "{{" and "}}" are fields, too; a lone "{" or "}" is one by itself.
std::vector<std::string> textFields(std::string_view text);

}  // namespace terrane::content
