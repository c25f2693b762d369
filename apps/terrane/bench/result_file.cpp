#include "apps/terrane/bench/result_file.h"

#include <fstream>
#include <sstream>

#include "terrane/base/files.h"

namespace terrane::app {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kSettings = "settings";

// What differs first, for people.
std::string difference(const json& there, const json& here) {
    for (const auto& [key, value] : here.items()) {
        const json other = there.contains(key) ? there[key] : json();
        if (other != value) return fmt::format("{} {} there, {} here", key, other.dump(), value.dump());
    }
    return "settings that this program does not know";
}

// A line of a run, taken into what was measured; false where it is none.
bool takeLine(const json& line, Measurements& measured) {
    if (!line.is_object() || !line.contains("cell") || !line["cell"].is_array()) return false;
    Cell cell;
    for (const json& argument : line["cell"]) {
        if (!argument.is_string()) return false;
        cell.arguments.push_back(argument.get<std::string>());
    }
    if (line.contains("result")) measured.runs[keyOf(cell)].push_back(line["result"]);
    return line.contains("result") || line.contains("failure");
}

}  // namespace

base::Result<ResultFile> ResultFile::create(const fs::path& path, const json& settings) {
    std::error_code ignored;
    if (fs::exists(path, ignored)) {
        return base::fail("{}: is there already; --resume goes on with it, or name another folder",
                          path.string());
    }
    ResultFile file(path);
    if (auto written = file.append({{kSettings, settings}}); !written) return tl::unexpected(written.error());
    return file;
}

base::Result<ResultFile> ResultFile::resume(const fs::path& path, const json& settings) {
    auto text = base::readFile(path);
    if (!text) return tl::unexpected(text.error());
    const std::size_t whole = text->rfind('\n') == std::string::npos ? 0 : text->rfind('\n') + 1;
    ResultFile file(path);
    std::istringstream lines(text->substr(0, whole));
    std::string line;
    for (std::size_t number = 1; std::getline(lines, line); ++number) {
        const json value = json::parse(line, nullptr, false);
        if (number == 1) {
            if (!value.is_object() || !value.contains(kSettings))
                return base::fail("{}:1: no results of terrane bench", path.string());
            if (value[kSettings] != settings)
                return base::fail("{}: results of other settings: {}", path.string(),
                                  difference(value[kSettings], settings));
        } else if (!takeLine(value, file.measured_)) {
            return base::fail("{}:{}: no result of terrane bench", path.string(), number);
        }
    }
    if (whole == 0) return base::fail("{}:1: no results of terrane bench", path.string());
    std::error_code error;
    if (whole < text->size()) fs::resize_file(path, whole, error);
    if (error) return base::fail("{}: cannot be written: {}", path.string(), error.message());
    return file;
}

base::Result<void> ResultFile::add(const Cell& cell, const json& result) {
    measured_.failures.erase(keyOf(cell));
    measured_.runs[keyOf(cell)].push_back(result);
    return append({{"cell", cell.arguments}, {"result", result}});
}

base::Result<void> ResultFile::addFailure(const Cell& cell, const std::string& reason) {
    measured_.failures[keyOf(cell)] = reason;
    return append({{"cell", cell.arguments}, {"failure", reason}});
}

base::Result<void> ResultFile::append(const json& line) const {
    std::ofstream out(path_, std::ios::app);
    // Bytes that are no UTF-8 may come from a driver.
    out << line.dump(-1, ' ', false, json::error_handler_t::replace) << '\n';
    out.close();
    if (!out) return base::fail("{}: cannot be written", path_.string());
    return {};
}

}  // namespace terrane::app
