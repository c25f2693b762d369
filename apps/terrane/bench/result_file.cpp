#include "apps/terrane/bench/result_file.h"

#include <fstream>
#include <sstream>

#include "terrane/base/files.h"

namespace terrane::app {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kSettings = "settings";

// Describes the first difference, for error messages.
std::string difference(const json& there, const json& here) {
    for (const auto& [key, value] : here.items()) {
        const json other = there.contains(key) ? there[key] : json();
        if (other != value) return fmt::format("{} {} there, {} here", key, other.dump(), value.dump());
    }
    return "settings that this program does not know";
}

}  // namespace

base::Result<ResultFile> ResultFile::create(const fs::path& path, const json& settings) {
    std::error_code ignored;
    if (fs::exists(path, ignored)) {
        return base::fail("{}: exists already; continue it with --resume, or name another folder",
                          path.string());
    }
    ResultFile file(path);
    TERRANE_TRY(file.append({{kSettings, settings}}));
    return file;
}

base::Result<ResultFile> ResultFile::resume(const fs::path& path, const json& settings) {
    auto text = TERRANE_TRY(base::readFile(path));
    const std::size_t whole = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
    ResultFile file(path);
    std::istringstream lines(text.substr(0, whole));
    std::string line;
    for (std::size_t number = 1; std::getline(lines, line); ++number) {
        const json value = json::parse(line, nullptr, false);
        if (number == 1) {
            if (!value.is_object() || !value.contains(kSettings))
                return base::fail("{}:1: not results of terrane bench", path.string());
            if (value[kSettings] != settings)
                return base::fail("{}: results of other settings: {}", path.string(),
                                  difference(value[kSettings], settings));
        } else if (!file.takeLine(value)) {
            return base::fail("{}:{}: not a result of terrane bench", path.string(), number);
        }
    }
    if (whole == 0) return base::fail("{}:1: not results of terrane bench", path.string());
    std::error_code error;
    if (whole < text.size()) fs::resize_file(path, whole, error);
    if (error) return base::fail("{}: cannot be written: {}", path.string(), error.message());
    return file;
}

bool ResultFile::takeLine(const json& line) {
    if (!line.is_object() || !line.contains("cell") || !line["cell"].is_array()) return false;
    Cell cell;
    for (const json& argument : line["cell"]) {
        if (!argument.is_string()) return false;
        cell.arguments.push_back(argument.get<std::string>());
    }
    if (line.contains("result")) ++runs_[keyOf(cell)];
    return line.contains("result") || line.contains("failure");
}

int ResultFile::runsOf(const Cell& cell) const {
    const auto found = runs_.find(keyOf(cell));
    return found == runs_.end() ? 0 : found->second;
}

std::string_view ResultFile::failureOf(const Cell& cell) const {
    const auto found = failures_.find(keyOf(cell));
    return found == failures_.end() ? std::string_view() : found->second;
}

base::Result<void> ResultFile::add(const Cell& cell, const json& result) {
    failures_.erase(keyOf(cell));
    ++runs_[keyOf(cell)];
    return append({{"cell", cell.arguments}, {"result", result}});
}

base::Result<void> ResultFile::addFailure(const Cell& cell, const std::string& reason) {
    failures_[keyOf(cell)] = reason;
    return append({{"cell", cell.arguments}, {"failure", reason}});
}

base::Result<void> ResultFile::append(const json& line) const {
    std::ofstream out(path_, std::ios::app);
    // A driver may report invalid UTF-8.
    out << line.dump(-1, ' ', false, json::error_handler_t::replace) << '\n';
    out.close();
    if (!out) return base::fail("{}: cannot be written", path_.string());
    return {};
}

}  // namespace terrane::app
