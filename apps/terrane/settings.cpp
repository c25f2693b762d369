#include "apps/terrane/settings.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

#include "apps/terrane/options.h"
#include "terrane/base/files.h"
#include "terrane/base/platform.h"

namespace terrane::app {

namespace {

// The value as written on the command line.
std::string textOf(const toml::node& value) {
    if (const auto text = value.value_exact<std::string>()) return *text;
    std::ostringstream out;
    value.visit([&](const auto& v) {
        if constexpr (toml::is_value<decltype(v)>) out << v;
    });
    return out.str();
}

// What the option cannot take; empty: it can.
std::string wrongKind(const CLI::Option& option, const toml::node& value) {
    const bool isFlag = option.get_expected_max() == 0, isList = option.get_expected_max() > 1;
    if (value.is_array()) return isList ? "" : "expected one value, not a list";
    if (value.is_boolean()) return isFlag ? "" : "expected a number or a text, not true or false";
    if (isFlag && !value.is_string()) return "expected true or false";
    return value.is_string() || value.is_number() ? "" : "expected a number or a text";
}

}  // namespace

base::Result<void> setFromToml(CLI::Option& flag, const toml::node& value) {
    if (const std::string wrong = wrongKind(flag, value); !wrong.empty()) return base::fail("{}", wrong);
    const toml::array* list = value.as_array();
    if (list && list->empty()) return {};
    try {
        if (list)
            for (const toml::node& element : *list) flag.add_result(textOf(element));
        else
            flag.add_result(textOf(value));
        flag.run_callback();
    } catch (const CLI::ConversionError&) {
        return base::fail("expected {}, got {:?}",
                          flag.get_expected_max() == 0 ? "true or false" : "a number", flag.results().back());
    } catch (const CLI::ParseError& error) {
        std::string what = error.what();
        const std::string prefix = flag.get_name() + ": ";
        if (what.starts_with(prefix)) what.erase(0, prefix.size());
        return base::fail("{}", what);
    }
    return {};
}

void useCurrentNames(toml::table& table) {
    std::vector<toml::key> former;
    for (auto&& [key, value] : table) {
        if (currentFlag(key.str()) != key.str()) former.push_back(key);
        if (toml::table* inner = value.as_table()) useCurrentNames(*inner);
        if (toml::array* array = value.as_array()) {
            for (toml::node& element : *array)
                if (toml::table* inner = element.as_table()) useCurrentNames(*inner);
        }
    }
    for (const toml::key& key : former) {
        // Keeps the source position, so that errors name the line.
        table.insert(toml::key(currentFlag(key.str()), toml::source_region(key.source())),
                     std::move(*table.get(key.str())));
        table.erase(key.str());
    }
}

namespace {

namespace fs = std::filesystem;

base::Result<void> applyOne(const fs::path& file, CLI::App& command, const toml::key& key,
                            const toml::node& node) {
    const auto wrong = [&](const std::string& what) {
        return base::fail("{}:{}: {}: {}", file.string(), node.source().begin.line, key.str(), what);
    };
    CLI::Option* option = command.get_option_no_throw("--" + std::string(key.str()));
    if (!option) return wrong("there is no such setting");
    if (!option->get_configurable()) return wrong("only on the command line");
    if (option->count() > 0) return {};
    const auto set = setFromToml(*option, node);
    return set ? set : wrong(set.error().message);
}

struct SettingsText {
    std::string text;
    toml::table table;
};

// Empty if there is no file.
base::Result<SettingsText> readSettings(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return SettingsText();
    auto text = TERRANE_TRY(base::readFile(file));
    toml::table table = TERRANE_TRY(base::parseToml(text, file.string()));
    useCurrentNames(table);
    return SettingsText{std::move(text), std::move(table)};
}

std::optional<std::string> valueOf(const SettingValues& values, const std::string& name) {
    const auto found = values.find(name);
    return found != values.end() ? std::optional(found->second) : std::nullopt;
}

// New values by setting; none: the setting is removed.
using Changes = std::map<std::string, std::optional<std::string>>;

Changes changesOf(const SettingValues& before, const SettingValues& after,
                  const std::vector<std::string>& graphics) {
    Changes changes;
    if (valueOf(before, "preset") != valueOf(after, "preset"))
        for (const std::string& name : graphics) changes[name] = valueOf(after, name);
    for (const auto& [name, value] : before)
        if (!after.contains(name)) changes[name] = std::nullopt;
    for (const auto& [name, value] : after)
        if (valueOf(before, name) != value) changes[name] = value;
    return changes;
}

// The byte offset of a position of the parser: line and code point, both counted from 1.
std::size_t offsetOf(std::string_view text, toml::source_position place) {
    std::size_t at = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;  // the parser does not count a byte order mark
    for (toml::source_index line = 1; line < place.line; ++line) at = text.find('\n', at) + 1;
    for (toml::source_index letter = 1; letter < place.column && at < text.size(); ++letter) {
        do ++at;
        while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80);
    }
    return at;
}

std::string tomlOf(const std::string& value) {
    std::ostringstream out;
    out << toml::value<std::string>(value);
    return out.str();
}

struct Replacement {
    std::size_t begin = 0, end = 0;  // bytes of the text
    std::string text;
};

// False if the file has the key under its former name.
bool isWritten(std::string_view text, const toml::key& key) {
    const std::size_t begin = offsetOf(text, key.source().begin), end = offsetOf(text, key.source().end);
    return text.substr(begin, end - begin).find(key.str()) != std::string_view::npos;
}

// Replaces the value; key and value if the file has the former name; or removes the lines of the setting.
Replacement replacementOf(std::string_view text, const toml::key& key, const toml::node& node,
                          const std::optional<std::string>& value) {
    const std::size_t end = offsetOf(text, node.source().end);
    if (value && isWritten(text, key)) return {offsetOf(text, node.source().begin), end, tomlOf(*value)};
    if (value)
        return {offsetOf(text, key.source().begin), end, std::string(key.str()) + " = " + tomlOf(*value)};
    const std::size_t newline = text.find('\n', end);
    return {offsetOf(text, {key.source().begin.line, 1}),
            newline == std::string_view::npos ? text.size() : newline + 1, ""};
}

// The rest of the text stays, comments too; new settings are appended.
std::string withChanges(const SettingsText& settings, const Changes& changes) {
    std::string text = settings.text, added;
    std::vector<Replacement> replacements;
    for (const auto& [name, value] : changes) {
        const auto found = settings.table.find(name);
        if (found != settings.table.end()) {
            replacements.push_back(replacementOf(text, found->first, found->second, value));
        } else if (value) {
            added += name + " = " + tomlOf(*value) + '\n';
        }
    }
    // From the end, so that the offsets before it stay valid.
    std::ranges::sort(replacements, std::greater<>(), &Replacement::begin);
    for (const Replacement& part : replacements) text.replace(part.begin, part.end - part.begin, part.text);
    if (text.empty()) text = "# Settings of Terrane: options of `terrane play` (see its --help).\n";
    if (!text.ends_with('\n')) text += '\n';
    return text + added;
}

}  // namespace

fs::path settingsPath() {
    const fs::path folder = base::platform::userFolder(base::platform::UserFolder::Settings);
    return folder.empty() ? folder : folder / "terrane" / "settings.toml";
}

base::Result<void> applySettings(const fs::path& file, CLI::App& command,
                                 const std::vector<std::string>& graphics) {
    if (file.empty()) return {};
    const auto read = TERRANE_TRY(readSettings(file));
    const toml::table& table = read.table;
    const CLI::Option* preset = command.get_option_no_throw("--preset");
    const bool standsAlone = preset && preset->count() > 0;
    // In the order of the options: the preset precedes the options that change it.
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_single_name();
        const bool isGraphics = std::find(graphics.begin(), graphics.end(), name) != graphics.end();
        const auto found = table.find(name);
        if (found == table.end() || (isGraphics && standsAlone)) continue;
        TERRANE_TRY(applyOne(file, command, found->first, found->second));
    }
    for (const auto& [key, node] : table) {
        if (command.get_option_no_throw("--" + std::string(key.str()))) continue;
        return applyOne(file, command, key, node);  // fails: there is no such setting
    }
    return {};
}

base::Result<void> writeChanges(const fs::path& file, const SettingValues& before, const SettingValues& after,
                                const std::vector<std::string>& graphics) {
    if (file.empty() || before == after) return {};
    const auto settings = TERRANE_TRY(readSettings(file));
    std::error_code ignored;  // an error shows when the file is written
    fs::create_directories(file.parent_path(), ignored);
    return base::writeFile(file, withChanges(settings, changesOf(before, after, graphics)));
}

}  // namespace terrane::app
