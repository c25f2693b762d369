#include "apps/terrane/window/settings.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <system_error>

#include "apps/terrane/toml_flags.h"

namespace terrane::app {
namespace {

namespace fs = std::filesystem;

fs::path absoluteFrom(const char* variable) {
    const char* value = std::getenv(variable);
    const fs::path path = value ? value : "";
    return path.is_absolute() ? path : fs::path();
}

base::Result<void> applyOne(const fs::path& file, CLI::App& command, const toml::key& key,
                            const toml::node& node) {
    const auto wrong = [&](const std::string& what) {
        return base::fail("{}:{}: {}: {}", file.string(), node.source().begin.line, key.str(), what);
    };
    CLI::Option* option = command.get_option_no_throw("--" + std::string(key.str()));
    if (!option) return wrong("there is no such setting");
    if (option->count() > 0) return {};
    const auto set = setFromToml(*option, node);
    return set ? set : wrong(set.error().message);
}

// Empty where there is no file.
base::Result<toml::table> readTable(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return toml::table();
    try {
        return toml::parse_file(file.string());
    } catch (const toml::parse_error& error) {
        return base::fail("{}:{}: {}", file.string(), error.source().begin.line, error.description());
    }
}

base::Result<void> writeTable(const fs::path& file, const toml::table& table) {
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    fs::path fresh = file;
    fresh += ".new";
    std::ofstream out(fresh);
    out << "# Settings of Terrane: options of `terrane play` (see its --help).\n" << table << '\n';
    out.close();
    if (out) fs::rename(fresh, file, error);
    if (!out || error) return base::fail("{}: cannot be written", file.string());
    return {};
}

std::optional<std::string> valueOf(const SettingValues& values, const std::string& name) {
    const auto found = values.find(name);
    return found != values.end() ? std::optional(found->second) : std::nullopt;
}

}  // namespace

fs::path settingsPath() {
    fs::path folder = absoluteFrom("XDG_CONFIG_HOME");
    if (folder.empty()) {
        folder = absoluteFrom("HOME");
        if (folder.empty()) return {};
        folder /= ".config";
    }
    return folder / "terrane" / "settings.toml";
}

base::Result<void> applySettings(const fs::path& file, CLI::App& command,
                                 const std::vector<std::string>& graphics) {
    if (file.empty()) return {};
    const auto read = readTable(file);
    if (!read) return tl::unexpected(read.error());
    const toml::table& table = *read;
    const bool standsAlone = command.get_option("--preset")->count() > 0;
    // In the order of the options: a preset comes before what is changed of it.
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_single_name();
        const bool isGraphics = std::find(graphics.begin(), graphics.end(), name) != graphics.end();
        const auto found = table.find(name);
        if (found == table.end() || (isGraphics && standsAlone)) continue;
        if (auto done = applyOne(file, command, found->first, found->second); !done) return done;
    }
    for (const auto& [key, node] : table) {
        if (command.get_option_no_throw("--" + std::string(key.str()))) continue;
        return applyOne(file, command, key, node);  // which says that there is none
    }
    return {};
}

base::Result<void> writeChanges(const fs::path& file, const SettingValues& before, const SettingValues& after,
                                const std::vector<std::string>& graphics) {
    if (file.empty() || before == after) return {};
    auto table = readTable(file);
    if (!table) return tl::unexpected(table.error());
    if (valueOf(before, "preset") != valueOf(after, "preset")) {
        for (const std::string& name : graphics) table->erase(name);
        for (const std::string& name : graphics) {
            if (const auto value = valueOf(after, name)) table->insert_or_assign(name, *value);
        }
    }
    for (const auto& [name, value] : before) {
        if (!after.contains(name)) table->erase(name);
    }
    for (const auto& [name, value] : after) {
        if (valueOf(before, name) != value) table->insert_or_assign(name, value);
    }
    return writeTable(file, *table);
}

}  // namespace terrane::app
