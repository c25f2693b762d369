// Results of functions that can fail because of their input (files, arguments, drivers). Broken invariants
// are asserted instead. An error has a message, one line for the user, and a code for callers to branch on.
#pragma once

#include <fmt/format.h>
#include <tl/expected.hpp>

#include <concepts>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

namespace terrane::base {

// Public functions check by require() for mistakes of library users: arguments and the order of calls. These
// checks stay in release builds; inner loops assert instead. Throws std::invalid_argument with `rule`, which
// names the function, unless the rule holds.
inline void require(bool holds, const char* rule) {
    if (!holds) [[unlikely]]
        throw std::invalid_argument(rule);
}

// Returns the text of an exception for messages: a plain text if memory or threads ran out, otherwise what().
// It allocates no memory, and its result is valid as long as the exception. Any thread may call it.
const char* textOf(const std::exception& exception) noexcept;

}  // namespace terrane::base

namespace terrane::base {

enum class ErrorCode : std::uint8_t {
    Failed,          // the default: no caller needs to know more than the message says
    BadInput,        // an argument, or content, that is not as documented
    NotFound,        // the named thing does not exist
    Io,              // the file system, or the network, refused or failed
    Damaged,         // of the right kind, but broken
    Incompatible,    // whole, but of another version, program or world
    Busy,            // in use by another program; may work later
    Unsupported,     // understood, but not in this build or on this machine
    OutOfResources,  // no room on the disk, no memory
    Refused,         // a wrong password, or no right to do this
};

// The message names the failure and its location, for example "blocks.toml:12: opacity: expected 0 to 15, got
// 40".
struct Error {
    ErrorCode code = ErrorCode::Failed;
    std::string message;
};

// Returns the system's message for an errno.
inline std::string systemReason(int errorNumber) {
    return std::generic_category().message(errorNumber);
}

// A value or an error. It must not be ignored silently: cast it to void if an error makes no difference.
template <class T>
class [[nodiscard]] Result : public tl::expected<T, Error> {
    using Base = tl::expected<T, Error>;

  public:
    Result() = default;
    Result(tl::unexpected<Error> error) : Base(std::move(error)) {}
    Result(Base base) : Base(std::move(base)) {}

    template <class U = T>
    requires(!std::derived_from<std::remove_cvref_t<U>, Base> &&
             !std::same_as<std::remove_cvref_t<U>, tl::unexpected<Error>> &&
             std::is_constructible_v<T, U>) explicit(!std::is_convertible_v<U, T>) Result(U&& value)
        : Base(tl::in_place, std::forward<U>(value)) {}
};

template <>
class [[nodiscard]] Result<void> : public tl::expected<void, Error> {
    using Base = tl::expected<void, Error>;

  public:
    Result() = default;
    Result(tl::unexpected<Error> error) : Base(std::move(error)) {}
    Result(Base base) : Base(std::move(base)) {}
};

// return fail(ErrorCode::NotFound, "{}: there is no such file", path);
template <class... Args>
[[nodiscard]] tl::unexpected<Error> fail(ErrorCode code, fmt::format_string<Args...> format, Args&&... args) {
    return tl::unexpected<Error>(Error{code, fmt::format(format, std::forward<Args>(args)...)});
}

// return fail("{}: cannot be read", path);
template <class... Args>
[[nodiscard]] tl::unexpected<Error> fail(fmt::format_string<Args...> format, Args&&... args) {
    return fail(ErrorCode::Failed, format, std::forward<Args>(args)...);
}

// TERRANE_TRY calls it. A value must be used: a lock that the caller drops would be released at once.
template <class T>
[[nodiscard]] T valueOf(Result<T>&& result) {
    return *std::move(result);
}
inline void valueOf(Result<void>&&) {}

}  // namespace terrane::base

// Evaluates to the value of a result, or returns its error from the function around it:
//
//     const auto text = TERRANE_TRY(readFile(path));
//     TERRANE_TRY(writeFile(path, text));
//
// It is a statement expression, which GCC and Clang have. Use it as a statement or as a whole initializer: a
// return from the middle of an expression leaves the rest of the expression open.
#define TERRANE_TRY(...) TERRANE_TRY_NAMED(TERRANE_TRY_JOIN(terraneResult, __COUNTER__), __VA_ARGS__)
#define TERRANE_TRY_NAMED(result, ...)                                 \
    __extension__({                                                    \
        auto result = (__VA_ARGS__);                                   \
        if (!result) return tl::unexpected(std::move(result).error()); \
        ::terrane::base::valueOf(std::move(result));                   \
    })
#define TERRANE_TRY_JOIN(a, b) TERRANE_TRY_JOINED(a, b)
#define TERRANE_TRY_JOINED(a, b) a##b
