// What an exception means, for messages. Any thread.
#pragma once

#include <exception>

namespace terrane::base {

// Plain words where memory or threads are short, the exception's own ones otherwise. Needs no memory; valid
// as long as the exception.
const char* textOf(const std::exception& exception) noexcept;

}  // namespace terrane::base
