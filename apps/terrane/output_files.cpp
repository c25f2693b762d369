#include "apps/terrane/output_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "terrane/base/platform.h"
#include "terrane/store/saves/save_path.h"
#include "terrane/store/saves/world_list.h"

namespace terrane::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOutput = "output";  // name of the validators that mark an option

// Worlds, servers' files and their keys, of whatever program.
bool isDatabaseOrKey(const fs::path& path) {
    constexpr std::string_view kStarts[] = {{"SQLite format 3\0", 16}, "-----BEGIN "};
    std::array<char, 16> start{};
    std::ifstream(path, std::ios::binary).read(start.data(), start.size());
    const std::string_view text(start.data(), start.size());
    return std::ranges::any_of(kStarts, [&](std::string_view begin) { return text.starts_with(begin); });
}

// An error unless base::writeFile() can write the file: it writes a temporary file beside it and renames
// that, so the folder must be writable.
std::string isWritable(const std::string& text) {
    const fs::path path(text);
    if (std::string wrong = isInAFolder(text); !wrong.empty()) return wrong;
    const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::exists(status) && !fs::is_regular_file(status))
        return fmt::format("\"{}\" is not a regular file", text);
    if (isDatabaseOrKey(path))
        return fmt::format("\"{}\" is a database or a key, which no output replaces", text);
    if (base::platform::isWritableFolder(folder)) return {};
    return fmt::format("\"{}\": nothing can be written in the folder {}", text, folder);
}

bool isOutput(CLI::Option& option) {
    try {
        return option.get_validator(kOutput) != nullptr;
    } catch (const CLI::OptionNotFound&) {
        return false;
    }
}

// The path without links, dots and double slashes, whether the file exists or not.
fs::path resolved(const fs::path& path) {
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error);
    const fs::path canonical = fs::weakly_canonical(absolute, error);
    return error ? absolute.lexically_normal() : canonical;
}

bool isSame(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return resolved(a) == resolved(b) || fs::equivalent(a, b, ignored);
}

bool isFileOf(const fs::path& path, const fs::path& folder) {
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored) || !fs::exists(path, ignored)) return false;
    const fs::path file = resolved(path), above = resolved(folder);
    return std::ranges::mismatch(above, file).in1 == above.end();
}

struct UsedPath {
    const CLI::Option* option = nullptr;
    fs::path path;
    bool isWritten = false;
};

// The paths that an option names: all files of a world; none for a URL, or if it names no path.
std::vector<fs::path> pathsOf(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const auto has = [&](std::string_view word) { return type.find(word) != std::string::npos; };
    std::vector<fs::path> paths;
    for (const std::string& text : option.results()) {
        if (text.empty()) continue;
        if (type.starts_with("NAME|FILE")) {
            const auto file = store::fileOf(store::worldLocation(text));
            if (!file) continue;
            for (fs::path& path : store::filesOf(*file)) paths.push_back(std::move(path));
        } else if (has("FILE") || has("DIR") || has("PATH") || has("PACK")) {
            paths.emplace_back(text);
        }
    }
    return paths;
}

}  // namespace

std::string isInAFolder(const std::string& text) {
    const fs::path path(text), folder = path.parent_path();
    std::error_code ignored;
    if (!path.has_filename() || fs::is_directory(path, ignored))
        return fmt::format("\"{}\" does not name a file", text);
    if (!folder.empty() && !fs::is_directory(folder, ignored))
        return fmt::format("\"{}\": there is no folder {}", text, folder.string());
    return {};
}

CLI::Option* writesFile(CLI::Option* option) {
    return option->check(CLI::Validator(isWritable, "", kOutput))->type_name("FILE");
}

CLI::Option* writesFolder(CLI::Option* option) {
    return writesWorld(option)->type_name("DIR");
}

CLI::Option* writesWorld(CLI::Option* option) {
    return option->check(CLI::Validator([](const std::string&) { return std::string(); }, "", kOutput));
}

base::Result<void> checkOutputs(CLI::App& command) {
    std::vector<UsedPath> used;
    for (CLI::Option* option : command.get_options())
        for (fs::path& path : pathsOf(*option)) used.push_back({option, std::move(path), isOutput(*option)});
    for (const UsedPath& output : used) {
        if (!output.isWritten) continue;
        for (const UsedPath& other : used) {
            if (other.option == output.option) continue;
            const bool isInside = !other.isWritten && isFileOf(output.path, other.path);
            if (!isInside && !isSame(output.path, other.path)) continue;
            return base::fail(
                base::ErrorCode::BadInput, "{}: {} {} {}", output.option->get_name(), output.path.string(),
                isInside ? "is a file in the folder of" : "is also a file of", other.option->get_name());
        }
    }
    return {};
}

}  // namespace terrane::app
