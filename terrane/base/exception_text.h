// Texts of exceptions for messages. Any thread.
#pragma once

#include <exception>

namespace terrane::base {

// A plain text if memory or threads ran out, otherwise what(). Allocates no memory; valid as long as the
// exception.
const char* textOf(const std::exception& exception) noexcept;

}  // namespace terrane::base
