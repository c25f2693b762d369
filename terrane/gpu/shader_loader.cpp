#include "terrane/gpu/shader_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <system_error>
#include <utility>

#include "terrane/base/files.h"

namespace terrane::gpu {

namespace {

std::string_view withoutLeadingSpace(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

// Removes the letters at the start of text and returns them.
std::string_view takeWord(std::string_view& text) {
    text = withoutLeadingSpace(text);
    const auto end = std::ranges::find_if_not(
        text, [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; });
    const std::string_view word(text.begin(), end);
    text.remove_prefix(word.size());
    return word;
}

// Whether text ends inside a block comment. `inside`: it begins inside one.
bool endsInComment(std::string_view text, bool inside) {
    while (true) {
        const std::size_t end = inside ? text.find("*/") : text.find("/*");
        if (!inside && text.find("//") < end) return false;
        if (end == std::string_view::npos) return inside;
        text.remove_prefix(end + 2);
        inside = !inside;
    }
}

// Tracks which part of which #if a line is in. Only conditions on __cplusplus are evaluated; others count as
// true.
class Conditions {
  public:
    // True if the directive is a condition.
    bool take(std::string_view word, std::string_view rest) {
        const bool ifdef = word == "ifdef";
        const bool ifndef = word == "ifndef";
        if (ifdef || ifndef || word == "if") {
            const bool onCpp = (ifdef || ifndef) && takeWord(rest) == "__cplusplus";
            parts_.push_back({.inCpp = onCpp && ifdef, .thenInCpp = onCpp && ifndef});
        } else if (word == "else" || word == "elif") {
            if (!parts_.empty()) parts_.back().inCpp = parts_.back().thenInCpp;
        } else if (word == "endif") {
            if (!parts_.empty()) parts_.pop_back();
        } else {
            return false;
        }
        return true;
    }

    [[nodiscard]] bool inCpp() const {
        return std::ranges::any_of(parts_, [](const Part& part) { return part.inCpp; });
    }

  private:
    struct Part {
        bool inCpp;      // this part is for C++ only
        bool thenInCpp;  // so are the parts after #else and #elif
    };
    std::vector<Part> parts_;
};

class Expander {
  public:
    Expander(const ShaderLookup& lookup, ShaderSource& out) : lookup_(lookup), out_(out) {}

    base::Result<void> expand(const std::string& file, const std::string& text) {
        const std::size_t number = out_.files.size();
        out_.files.push_back(file);
        out_.text += fmt::format("#line 1 {}\n", number);

        Conditions conditions;
        bool inComment = false;
        std::size_t line = 0;
        std::string_view rest = text;
        while (!rest.empty()) {
            const std::string_view current = rest.substr(0, rest.find('\n'));
            rest.remove_prefix(std::min(current.size() + 1, rest.size()));
            ++line;
            const bool code = !inComment;
            inComment = endsInComment(current, inComment);
            const Place place{file, number, line};
            TERRANE_TRY(code ? expandLine(current, place, conditions) : keep(current));
        }
        return {};
    }

  private:
    struct Place {
        const std::string& file;
        std::size_t number;
        std::size_t line;
    };

    base::Result<void> keep(std::string_view line) {
        out_.text += line;
        out_.text += '\n';
        return {};
    }

    base::Result<void> expandLine(std::string_view line, const Place& place, Conditions& conditions) {
        std::string_view directive = withoutLeadingSpace(line);
        const bool inCpp = conditions.inCpp();
        if (!directive.starts_with('#')) return keep(inCpp ? std::string_view() : line);
        directive.remove_prefix(1);
        const std::string_view word = takeWord(directive);
        // Conditions within a part for C++ are kept too, so that every #endif has its #if.
        if (conditions.take(word, directive)) return keep(line);
        if (inCpp) return keep({});
        if (word == "include") return include(withoutLeadingSpace(directive), place);
        return keep(line);
    }

    base::Result<void> include(std::string_view operand, const Place& place) {
        const std::size_t end = operand.find('"', 1);
        if (!operand.starts_with('"') || end == std::string_view::npos)
            return base::fail("{}:{}: #include: expected a path in double quotes", place.file, place.line);
        const std::string path(operand.substr(1, end - 1));
        if (std::ranges::find(out_.files, path) != out_.files.end()) return keep({});
        const std::optional<std::string> text = lookup_(path);
        if (!text) return base::fail("{}:{}: #include: no file {}", place.file, place.line, path);
        if (base::Result<void> done = expand(path, *text); !done) return done;
        out_.text += fmt::format("#line {} {}\n", place.line + 1, place.number);
        return {};
    }

    const ShaderLookup& lookup_;
    ShaderSource& out_;
};

// Source number at the start of a message line: number, then '(' or ':', then a line number.
struct SourceNumber {
    std::size_t begin;
    std::size_t end;
    std::size_t value;
};

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

std::optional<SourceNumber> findSourceNumber(std::string_view line) {
    std::size_t begin = 0;
    for (std::string_view prefix : {"ERROR: ", "WARNING: "})
        if (line.starts_with(prefix)) begin = prefix.size();
    std::size_t value = 0;
    const char* first = line.data() + begin;
    const auto [last, error] = std::from_chars(first, line.data() + line.size(), value);
    if (error != std::errc()) return std::nullopt;
    const std::size_t end = begin + static_cast<std::size_t>(last - first);
    const bool separated = end + 1 < line.size() && (line[end] == ':' || line[end] == '(');
    if (!separated || !isDigit(line[end + 1])) return std::nullopt;
    return SourceNumber{begin, end, value};
}

}  // namespace

base::Result<ShaderSource> expandIncludes(std::string_view name, const ShaderLookup& lookup) {
    assert(lookup && "there is a way to find files");
    ShaderSource source;
    const std::optional<std::string> text = lookup(name);
    if (!text) return base::fail("{}: no such shader", name);
    if (base::Result<void> done = Expander(lookup, source).expand(std::string(name), *text); !done)
        return tl::unexpected(done.error());
    return source;
}

std::string shaderHeader(ShaderStage stage, const ShaderDefines& defines) {
    std::string header = "#version 450 core\n";
    // Provides gl_DrawIDARB and gl_BaseInstanceARB, in vertex shaders only.
    if (stage == ShaderStage::Vertex) header += "#extension GL_ARB_shader_draw_parameters : require\n";
    for (const auto& [name, value] : defines) header += fmt::format("#define {} {}\n", name, value);
    return header;
}

std::string replaceSourceNumbers(std::string_view log, std::span<const std::string> files) {
    std::string named;
    while (!log.empty()) {
        const std::string_view line = log.substr(0, log.find('\n'));
        const bool ended = line.size() < log.size();
        log.remove_prefix(ended ? line.size() + 1 : line.size());
        const std::optional<SourceNumber> number = findSourceNumber(line);
        if (number && number->value < files.size()) {
            named += line.substr(0, number->begin);
            named += files[number->value];
            named += line.substr(number->end);
        } else {
            named += line;
        }
        if (ended) named += '\n';
    }
    return named;
}

ShaderLoader::ShaderLoader(std::span<const base::EmbeddedFile> embedded, std::filesystem::path shaderRoot)
    : shaderRoot_(std::move(shaderRoot)) {
    addFiles(embedded);
}

void ShaderLoader::addFiles(std::span<const base::EmbeddedFile> embedded) {
    for (const base::EmbeddedFile& file : embedded)
        embedded_.insert_or_assign(std::string(file.path), file.data);
}

base::Result<ShaderSource> ShaderLoader::load(std::string_view name, ShaderStage stage,
                                              const ShaderDefines& defines) const {
    base::Result<ShaderSource> source =
        expandIncludes(name, [this](std::string_view path) { return find(path); });
    if (source) source->text.insert(0, shaderHeader(stage, defines));
    return source;
}

std::optional<std::string> ShaderLoader::find(std::string_view path) const {
    if (!shaderRoot_.empty())
        if (base::Result<std::string> text = base::readFile(shaderRoot_ / path)) return *std::move(text);
    if (const auto found = embedded_.find(path); found != embedded_.end()) return std::string(found->second);
    return std::nullopt;
}

std::optional<std::filesystem::file_time_type> ShaderLoader::newestWrite() const {
    namespace fs = std::filesystem;
    std::optional<fs::file_time_type> newest;
    if (shaderRoot_.empty()) return newest;
    std::error_code failed;  // a file may be replaced right now
    fs::recursive_directory_iterator file(shaderRoot_ / "terrane", failed);
    for (; !failed && file != fs::recursive_directory_iterator(); file.increment(failed)) {
        const fs::path extension = file->path().extension();
        if (extension != ".glsl" && extension != ".h") continue;
        std::error_code isGone;
        const fs::file_time_type written = file->last_write_time(isGone);
        if (!isGone) newest = std::max(newest.value_or(written), written);
    }
    return newest;
}

}  // namespace terrane::gpu

namespace terrane::embedded {
std::span<const base::EmbeddedFile> shaders();
}  // namespace terrane::embedded

namespace terrane::gpu {

ShaderLoader builtInShaders(const std::string& shaderRoot) {
    return ShaderLoader(embedded::shaders(), shaderRoot);
}

}  // namespace terrane::gpu
