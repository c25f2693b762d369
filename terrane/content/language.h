// Names of blocks and texts of the user interface in a language. The files are in assets/languages and are
// compiled in. All are plain values; any thread may use them.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/blocks/block_type.h"

namespace terrane::content {

// Returns the format fields of a text in their order: those of printf ("%d") and of fmt ("{:.1f}"). "%%",
// "{{" and "}}" are fields, too; a lone "{" or "}" is a field by itself.
std::vector<std::string> textFields(std::string_view text);

// Languages that come with the program.
constexpr std::array<std::string_view, 3> kLanguages{"en", "cs", "de"};

// Bounds of a file: the text of all entries together stays below 2 × 4,096 × 2 KiB = 16 MiB.
constexpr std::size_t kMaxLanguageEntries = 4096;  // of each table
constexpr std::size_t kMaxLanguageText = 2048;     // bytes of a text
constexpr std::size_t kMaxBlockNameText = 64;      // bytes of a block's name as shown

struct Language {
    using Texts = std::map<std::string, std::string, std::less<>>;

    Texts blocks;  // shown name by the block's name
    Texts texts;   // translation by the English text
};

// Reads a file with the tables [blocks] and [text]. A translation has the fields of the English text (%d, {})
// in the same order. Errors read "file:line: key: expected …, got …".
base::Result<Language> parseLanguage(std::string_view toml, std::string_view file);
// Loads one of kLanguages.
base::Result<Language> loadLanguage(std::string_view code);

// Returns the code in kLanguages for a locale of the system, "de" for "de_AT.UTF-8"; "en" for languages
// without a file.
std::string_view languageOfLocale(std::string_view locale);

// Returns the display name of a block, "Oak log"; it is made from the block's own name if the language has
// none.
std::string blockName(const Language& language, const world::BlockType& type);
// Does the same for an item, by its name; names of items and blocks are in one table.
std::string itemName(const Language& language, std::string_view name);
// Returns the translation, or the English text itself. The result is null-terminated if `english` is.
std::string_view text(const Language& language, std::string_view english);

}  // namespace terrane::content
