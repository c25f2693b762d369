// The files of assets/ that are compiled in, for the sources of this module.
#pragma once

#include <optional>
#include <string_view>

namespace terrane::content {

std::optional<std::string_view> findContent(std::string_view path);

}  // namespace terrane::content
