#include "apps/terrane/options.h"

#include <charconv>
#include <map>
#include <thread>

namespace terrane::app {
namespace {

constexpr int kMaxPictureSide = 16384;

glm::ivec2 parseSize(const std::string& text) {
    int width = 0, height = 0;
    const char* end = text.data() + text.size();
    const auto x = std::from_chars(text.data(), end, width);
    const bool hasCross = x.ec == std::errc() && x.ptr != end && *x.ptr == 'x';
    const auto y = hasCross ? std::from_chars(x.ptr + 1, end, height) : x;
    const bool isGood = hasCross && y.ec == std::errc() && y.ptr == end;
    if (!isGood || width < 1 || height < 1 || width > kMaxPictureSide || height > kMaxPictureSide) {
        throw CLI::ValidationError(
            "--size",
            fmt::format("expected WIDTHxHEIGHT with sides of 1 to {}, got \"{}\"", kMaxPictureSide, text));
    }
    return {width, height};
}

Area parseArea(const std::string& text) {
    const auto n = parseNumbers(text, 4, "--area: expected X0,Y0,X1,Y1 in chunks");
    for (const double v : n) {
        if (v != static_cast<double>(static_cast<std::int64_t>(v)) || v < world::kMinChunk ||
            v > world::kMaxChunk + 1.0) {
            throw CLI::ValidationError("--area", fmt::format("chunk coordinates are integers from {} to {}",
                                                             world::kMinChunk, world::kMaxChunk));
        }
    }
    const Area area{static_cast<std::int32_t>(n[0]), static_cast<std::int32_t>(n[1]),
                    static_cast<std::int32_t>(n[2]), static_cast<std::int32_t>(n[3])};
    if (area.x1 <= area.x0 || area.y1 <= area.y0) {
        throw CLI::ValidationError("--area", fmt::format("\"{}\" is empty: the end X1,Y1 is excluded", text));
    }
    return area;
}

}  // namespace

std::vector<double> parseNumbers(const std::string& text, std::size_t count, const std::string& form) {
    std::vector<double> numbers;
    const char *at = text.data(), *end = text.data() + text.size();
    while (at <= end) {
        double value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc() || !(value > -1e15 && value < 1e15)) break;
        numbers.push_back(value);
        at = next;
        if (at == end || *at != ',') break;
        ++at;
    }
    if (at != end || numbers.size() != count)
        throw CLI::ValidationError(fmt::format("{}, got \"{}\"", form, text));
    return numbers;
}

void addWorldOptions(CLI::App& command, WorldOptions& options) {
    command.add_option("--seed", options.seed, "Seed of the world")->capture_default_str();
    command.add_option("--generator", options.generator, "Generator of the world: overworld or flat")
        ->capture_default_str();
    command.add_option("--threads", options.threads, "Worker threads (default: one for each processor)")
        ->check(CLI::Range(1, 256));
}

void addGraphicsOptions(CLI::App& command, GraphicsOptions& options) {
    command
        .add_option_function<std::string>(
            "--size", [&](const std::string& text) { options.size = parseSize(text); },
            "Picture size in pixels")
        ->type_name("WxH")
        ->default_str("1280x720");
    command.add_option("--view-distance", options.viewDistance, "How far one sees, in chunks")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    command.add_option("--samples", options.samples, "Anti-aliasing: samples a pixel")
        ->check(CLI::IsMember({1, 2, 4, 8}))
        ->capture_default_str();
    const std::map<std::string, render::View> views = {
        {"color", render::View::Color}, {"normal", render::View::Normal}, {"depth", render::View::Depth}};
    command.add_option("--view", options.view, "What to show")
        ->transform(CLI::CheckedTransformer(views).description("color, normal or depth"))
        ->default_str("color");
    command
        .add_option("--shader-root", options.shaderRoot, "Source tree to read shaders from, for development")
        ->check(CLI::ExistingDirectory);
    command.add_flag("--debug-gl", options.debugGl, "Report errors of the graphics driver");
}

void addAreaOption(CLI::App& command, std::optional<Area>& area) {
    command
        .add_option_function<std::string>(
            "--area", [&](const std::string& text) { area = parseArea(text); }, "Chunks, the end excluded")
        ->type_name("X0,Y0,X1,Y1");
}

unsigned threadCount(const WorldOptions& options) {
    return options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace terrane::app
