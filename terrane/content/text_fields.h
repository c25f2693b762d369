// Format fields of texts: those of printf ("%d") and of fmt ("{:.1f}").
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace terrane::content {

// The fields in the order of the text. "%%", "{{" and "}}" are fields, too; a lone "{" or "}" is a field by
// itself.
std::vector<std::string> textFields(std::string_view text);

}  // namespace terrane::content
