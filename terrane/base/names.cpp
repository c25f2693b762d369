#define U_SHOW_CPLUSPLUS_API 0  // ICU's C API alone

#include "terrane/base/names.h"

#include <fmt/format.h>
#include <unicode/uchar.h>
#include <unicode/unorm2.h>
#include <unicode/uset.h>
#include <unicode/uspoof.h>
#include <unicode/ustring.h>

#include <algorithm>
#include <memory>
#include <new>
#include <stdexcept>

#include "terrane/base/text.h"

namespace terrane::base {
namespace {

// Normalization to NFC makes a text in UTF-8 at most three times as long.
constexpr std::size_t kMaxGrowth = 3;
// Longer texts are no names: nothing is computed for them.
constexpr std::size_t kMaxTextBytes = 4096;

struct CloseIcu {
    void operator()(USpoofChecker* checker) const { uspoof_close(checker); }
    void operator()(USet* set) const { uset_close(set); }
};
using CheckerPtr = std::unique_ptr<USpoofChecker, CloseIcu>;
using SetPtr = std::unique_ptr<USet, CloseIcu>;

// Fails only without memory or without ICU's data.
void requireIcu(UErrorCode code) {
    if (code == U_MEMORY_ALLOCATION_ERROR) throw std::bad_alloc();
    if (U_FAILURE(code)) throw std::runtime_error(fmt::format("ICU: {}", u_errorName(code)));
}

SetPtr setOf(std::u16string_view pattern) {
    UErrorCode code = U_ZERO_ERROR;
    SetPtr set(uset_openPattern(pattern.data(), static_cast<std::int32_t>(pattern.size()), &code));
    requireIcu(code);
    return set;
}

SetPtr allowedCharacters() {
    UErrorCode code = U_ZERO_ERROR;
    const USet* recommended = uspoof_getRecommendedSet(&code);
    requireIcu(code);
    SetPtr allowed(uset_cloneAsThawed(recommended));
    if (!allowed) throw std::bad_alloc();
    uset_addRange(allowed.get(), ' ', '~');
    uset_addAll(allowed.get(),
                setOf(u"[[:Emoji_Presentation:]-[:Regional_Indicator:]-[:Emoji_Modifier:]]").get());
    uset_removeAll(allowed.get(), setOf(u"[[:Default_Ignorable_Code_Point:][:C:][:Zl:][:Zp:]]").get());
    uset_freeze(allowed.get());
    return allowed;
}

struct NameChecker {
    SetPtr allowed = allowedCharacters();
    CheckerPtr spoof;

    NameChecker() {
        UErrorCode code = U_ZERO_ERROR;
        spoof.reset(uspoof_open(&code));
        requireIcu(code);
        uspoof_setAllowedChars(spoof.get(), allowed.get(), &code);
        uspoof_setRestrictionLevel(spoof.get(), USPOOF_MODERATELY_RESTRICTIVE);
        uspoof_setChecks(spoof.get(),
                         USPOOF_RESTRICTION_LEVEL | USPOOF_INVISIBLE | USPOOF_CHAR_LIMIT |
                             USPOOF_MIXED_NUMBERS | USPOOF_HIDDEN_OVERLAY,
                         &code);
        requireIcu(code);
    }
};

const NameChecker& checker() {
    static const NameChecker made;
    return made;
}

// Calls function(buffer, capacity, code), which returns the length of its result, with enough room.
template <class Text, class Function>
Text filled(std::size_t room, Function function) {
    Text text(std::max<std::size_t>(room, 1), typename Text::value_type{});
    for (int attempt = 0; attempt < 2; ++attempt) {
        UErrorCode code = U_ZERO_ERROR;
        const auto length =
            static_cast<std::size_t>(function(text.data(), static_cast<std::int32_t>(text.size()), &code));
        const bool isShort = code == U_BUFFER_OVERFLOW_ERROR;
        if (!isShort) requireIcu(code);
        text.resize(length);
        if (!isShort) break;
    }
    return text;
}

// `text` is UTF-8.
std::u16string utf16(std::string_view text) {
    return filled<std::u16string>(text.size(), [&](char16_t* out, std::int32_t room, UErrorCode* code) {
        std::int32_t length = 0;
        u_strFromUTF8(out, room, &length, text.data(), static_cast<std::int32_t>(text.size()), code);
        return length;
    });
}

std::string utf8(std::u16string_view text) {
    return filled<std::string>(text.size() * 3, [&](char* out, std::int32_t room, UErrorCode* code) {
        std::int32_t length = 0;
        u_strToUTF8(out, room, &length, text.data(), static_cast<std::int32_t>(text.size()), code);
        return length;
    });
}

std::u16string normalized(const UNormalizer2* form, std::u16string_view text) {
    return filled<std::u16string>(text.size() * kMaxGrowth, [&](char16_t* out, std::int32_t room,
                                                                UErrorCode* code) {
        return unorm2_normalize(form, text.data(), static_cast<std::int32_t>(text.size()), out, room, code);
    });
}

const UNormalizer2* nfc() {
    UErrorCode code = U_ZERO_ERROR;
    const UNormalizer2* form = unorm2_getNFCInstance(&code);
    requireIcu(code);
    return form;
}

// Without upper case, invisible characters and variants such as full width.
const UNormalizer2* nfkcCaseFolded() {
    UErrorCode code = U_ZERO_ERROR;
    const UNormalizer2* form = unorm2_getNFKCCasefoldInstance(&code);
    requireIcu(code);
    return form;
}

std::string skeletonOf(std::u16string_view text) {
    const auto skeleton = filled<std::u16string>(
        text.size() * kMaxGrowth, [&](char16_t* out, std::int32_t room, UErrorCode* code) {
            return uspoof_getSkeleton(checker().spoof.get(), 0, text.data(),
                                      static_cast<std::int32_t>(text.size()), out, room, code);
        });
    return utf8(skeleton);
}

bool isText(std::string_view text) {
    return text.size() <= kMaxTextBytes && isUtf8(text);
}

tl::unexpected<Error> refused(std::string message) {
    return fail(ErrorCode::BadInput, "a name {}", message);
}

// The first character that no name has.
std::optional<char32_t> forbiddenIn(std::string_view name) {
    while (!name.empty()) {
        const CodePoint next = firstCodePoint(name);
        if (!uset_contains(checker().allowed.get(), static_cast<UChar32>(next.code))) return next.code;
        name.remove_prefix(next.bytes);
    }
    return std::nullopt;
}

bool beginsWithMark(std::string_view name) {
    return (U_GET_GC_MASK(static_cast<UChar32>(firstCodePoint(name).code)) & U_GC_M_MASK) != 0;
}

}  // namespace

Result<std::string> checkName(std::string_view text, std::size_t maxBytes) {
    if (text.empty()) return refused("has at least one character");
    if (text.size() > maxBytes * kMaxGrowth || text.size() > kMaxTextBytes)
        return refused(fmt::format("has at most {} bytes", maxBytes));
    if (!isUtf8(text)) return refused("is text in UTF-8");
    std::string name = normalizedName(text);
    if (name.size() > maxBytes) return refused(fmt::format("has at most {} bytes", maxBytes));
    if (const auto forbidden = forbiddenIn(name))
        return refused(
            fmt::format("cannot have the character U+{:04X}", static_cast<std::uint32_t>(*forbidden)));
    if (name.front() == ' ' || name.back() == ' ') return refused("has no spaces at its ends");
    if (name.find("  ") != std::string::npos) return refused("has no two spaces in a row");
    if (beginsWithMark(name)) return refused("begins with no combining mark");
    UErrorCode code = U_ZERO_ERROR;
    const std::int32_t failed = uspoof_check2UTF8(checker().spoof.get(), name.data(),
                                                  static_cast<std::int32_t>(name.size()), nullptr, &code);
    requireIcu(code);
    if ((failed & (USPOOF_INVISIBLE | USPOOF_HIDDEN_OVERLAY)) != 0)
        return refused("has no marks that cannot be seen");
    if ((failed & USPOOF_MIXED_NUMBERS) != 0) return refused("has digits of several scripts");
    if (failed != 0)
        return refused("has letters of scripts that are easily confused, such as Latin and Cyrillic");
    return name;
}

std::string normalizedName(std::string_view text) {
    return isText(text) ? utf8(normalized(nfc(), utf16(text))) : std::string(text);
}

NameLooks looksOf(std::string_view name) {
    if (!isText(name)) return {std::string(name), std::string(name)};
    const std::u16string text = utf16(name);
    return {skeletonOf(text), skeletonOf(normalized(nfkcCaseFolded(), text))};
}

namespace {

bool isLike(const NameLooks& looks, std::string_view name) {
    const NameLooks other = looksOf(name);
    return looks.written == other.written || looks.folded == other.folded;
}

}  // namespace

bool isConfusable(std::string_view a, std::string_view b) {
    return isLike(looksOf(a), b);
}

std::string nameLike(std::string_view name, std::span<const std::string> known) {
    const NameLooks looks = looksOf(name);
    const auto found =
        std::ranges::find_if(known, [&](const std::string& other) { return isLike(looks, other); });
    return found == known.end() ? std::string() : *found;
}

}  // namespace terrane::base
