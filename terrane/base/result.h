// Results and errors: what a function returns that can fail because of its input (files, arguments, drivers).
// Broken invariants are asserted instead. Errors are shown to a person as one line.
#pragma once

#include <fmt/format.h>

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace terrane::base {

// One line that names what failed and where, for example "blocks.toml:12: opacity: expected 0 to 15, got 40".
struct Error {
    std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

// return fail("{}: cannot be read", path);
template <class... Args>
[[nodiscard]] tl::unexpected<Error> fail(fmt::format_string<Args...> format, Args&&... args) {
    return tl::unexpected<Error>(Error{fmt::format(format, std::forward<Args>(args)...)});
}

}  // namespace terrane::base
