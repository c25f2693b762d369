// Names that people give to players, claims, places, worlds and files: one rule for all, by the normalizer
// and the spoof checker of ICU. Pure functions; any thread.
//
// A name is text in Unicode's normal form NFC. Its characters are those that Unicode allows in identifiers
// (UTS 39, "Allowed"), printable ASCII, and emoji of one character; none is invisible. No spaces are at its
// ends and no two in a row. Its letters are of one script, or of Latin and one other script except Cyrillic
// and Greek (UTS 39, "Moderately Restrictive", which also allows the scripts of Japanese, Korean and Chinese
// together). The rule is for new names: those that were stored before stay.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::base {

// The name in its normal form, or an error that states in one line what is wrong. It begins with "a name".
[[nodiscard]] Result<std::string> checkName(std::string_view text, std::size_t maxBytes);

// The normal form NFC. Bytes that are not UTF-8 stay as they are.
[[nodiscard]] std::string normalizedName(std::string_view text);

// Texts that are equal for names that look alike (UTS 39, skeletons): as they are written, and without upper
// case, invisible characters and variants such as full width. Two names are confusable if either is equal.
struct NameLooks {
    std::string written, folded;
};
[[nodiscard]] NameLooks looksOf(std::string_view name);
[[nodiscard]] bool isConfusable(std::string_view a, std::string_view b);

// The first known name that is confusable with `name`; empty if there is none.
[[nodiscard]] std::string nameLike(std::string_view name, std::span<const std::string> known);

}  // namespace terrane::base
