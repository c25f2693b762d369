#include "terrane/content/language.h"

#include <algorithm>
#include <initializer_list>
#include <optional>

#include "terrane/base/text.h"
#include "terrane/content/content_files_internal.h"
#include "terrane/world/blocks/content_table.h"

namespace terrane::content {

namespace {

// Length of the field of printf that begins with the percent sign at `at`.
std::size_t printfLength(std::string_view text, std::size_t at) {
    constexpr std::string_view kBeforeType = "-+ #0123456789.*hlLqjzt";
    const std::size_t type = text.find_first_not_of(kBeforeType, at + 1);
    return std::min(type, text.size() - 1) - at + 1;
}

// Length of the field of fmt that begins with the brace at `at`.
std::size_t braceLength(std::string_view text, std::size_t at) {
    const bool isDoubled = at + 1 < text.size() && text[at + 1] == text[at];
    if (isDoubled) return 2;
    const std::size_t end = text.find('}', at);
    return text[at] == '{' && end != text.npos ? end - at + 1 : 1;
}

}  // namespace

std::vector<std::string> textFields(std::string_view text) {
    std::vector<std::string> fields;
    std::size_t at = text.find_first_of("%{}");
    while (at != text.npos) {
        const std::size_t length = text[at] == '%' ? printfLength(text, at) : braceLength(text, at);
        fields.emplace_back(text.substr(at, length));
        at = text.find_first_of("%{}", at + length);
    }
    return fields;
}

namespace {

using world::ContentTable;

bool isShown(std::string_view text, bool mayBreak) {
    return std::ranges::all_of(text, [&](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return (byte >= ' ' && byte != 0x7F) || (mayBreak && c == '\n');
    });
}

std::string quoted(std::string_view text) {
    constexpr std::size_t kMaxShown = 60;
    std::size_t length = std::min(text.size(), kMaxShown);
    while (length < text.size() && length > 0 && (text[length] & 0xC0) == 0x80)
        --length;  // do not split a character
    return fmt::format("\"{}{}\"", text.substr(0, length), length < text.size() ? "…" : "");
}

struct EntryRules {
    std::string_view table;
    std::size_t maxBytes = 0;
    bool isFormat = false;  // may have line breaks and the fields of its key
};

void readEntry(ContentTable& table, const EntryRules& rules, const toml::key& key, const toml::node& node,
               Language::Texts& texts) {
    const std::string path = fmt::format("{}.{}", rules.table, quoted(key.str()));
    const auto value = node.value_exact<std::string>();
    if (!value || value->empty() || value->size() > rules.maxBytes || !isShown(*value, rules.isFormat))
        return table.expected(node, path,
                              fmt::format("a text of 1 to {} bytes that can be shown", rules.maxBytes));
    if (rules.isFormat && textFields(*value) != textFields(key.str()))
        return table.expected(node, path, "the fields of the English text in their order");
    texts.emplace(key.str(), *value);
}

Language::Texts readTexts(ContentTable& top, const EntryRules& rules, std::string_view file,
                          std::optional<std::string>& error) {
    Language::Texts texts;
    const toml::node* found = top.node(rules.table);
    if (!found) return texts;
    const toml::table* entries = found->as_table();
    if (!entries || entries->size() > kMaxLanguageEntries) {
        top.expected(*found, rules.table, fmt::format("a table of at most {} texts", kMaxLanguageEntries));
        return texts;
    }
    ContentTable table(*entries, file, error);
    for (const auto& [key, node] : *entries) readEntry(table, rules, key, node, texts);
    return texts;
}

base::Result<Language> readLanguage(const toml::table& root, std::string_view file) {
    std::optional<std::string> error;
    ContentTable top(root, file, error);
    top.rejectUnknown(std::initializer_list<std::string_view>{"blocks", "text"});
    Language language;
    language.blocks = readTexts(top, {"blocks", kMaxBlockNameText, false}, file, error);
    language.texts = readTexts(top, {"text", kMaxLanguageText, true}, file, error);
    if (error) return base::fail(base::ErrorCode::BadInput, "{}", base::inOneLine(std::move(*error)));
    return language;
}

}  // namespace

base::Result<Language> parseLanguage(std::string_view toml, std::string_view file) {
    return readLanguage(TERRANE_TRY(base::parseToml(toml, file)), file);
}

base::Result<Language> loadLanguage(std::string_view code) {
    const std::string path = fmt::format("languages/{}.toml", code);
    const auto data = findContent(path);
    if (!data) return base::fail(base::ErrorCode::NotFound, "{}: not in the program", path);
    return parseLanguage(*data, path);
}

std::string_view languageOfLocale(std::string_view locale) {
    const std::string_view code = locale.substr(0, locale.find_first_of("_.@"));
    const auto found = std::ranges::find(kLanguages, code);
    return found != kLanguages.end() ? *found : kLanguages[0];
}

std::string blockName(const Language& language, const world::BlockType& type) {
    return itemName(language, type.name);
}

std::string itemName(const Language& language, std::string_view name) {
    const auto found = language.blocks.find(name);
    if (found != language.blocks.end()) return found->second;
    std::string words(name.substr(name.find(':') + 1));  // without the name of its pack
    std::ranges::replace(words, '_', ' ');
    if (!words.empty() && words[0] >= 'a' && words[0] <= 'z')
        words[0] = static_cast<char>(words[0] - 'a' + 'A');
    return words;
}

std::string_view text(const Language& language, std::string_view english) {
    const auto found = language.texts.find(english);
    return found != language.texts.end() ? std::string_view(found->second) : english;
}

}  // namespace terrane::content
