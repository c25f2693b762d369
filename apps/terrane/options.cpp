#include "apps/terrane/options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "apps/terrane/output_files.h"
#include "terrane/game/player_items.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/store/saves/save_path.h"

namespace terrane::app {

namespace {

struct Renamed {
    std::string_view former, current;
};

constexpr std::array<Renamed, 1> kCommands = {{{"fly", "flight-bench"}}};
constexpr std::array<Renamed, 7> kFlags = {{{"aggregation", "merging"},
                                            {"atmosphere", "distance-fog"},
                                            {"better-texturing", "sharp-filtering"},
                                            {"for", "duration"},
                                            {"position", "bookmark"},
                                            {"region-height", "mesh-section-height"},
                                            {"save-game", "world"}}};
constexpr std::array<Renamed, 1> kValues = {{{"aggregation", "merging"}}};  // of --view

std::string_view currentIn(std::span<const Renamed> names, std::string_view name) {
    const auto found = std::ranges::find(names, name, &Renamed::former);
    return found != names.end() ? found->current : name;
}

std::string withCurrentFlag(std::string_view argument) {
    if (!argument.starts_with("--")) return std::string(argument);
    const std::string_view name = argument.substr(2, argument.find('=') - 2);
    return std::string("--").append(currentFlag(name)).append(argument.substr(2 + name.size()));
}

}  // namespace

std::string_view currentFlag(std::string_view name) {
    return currentIn(kFlags, name);
}

std::string_view currentValue(std::string_view value) {
    return currentIn(kValues, value);
}

std::vector<std::string> withCurrentNames(std::span<const char* const> arguments) {
    std::vector<std::string> current;
    for (const char* argument : arguments) current.push_back(withCurrentFlag(argument));
    if (current.size() > 1) current[1] = currentIn(kCommands, current[1]);
    return current;
}

namespace {

void parseSeed(const std::string& text, io::WorldOptions& options) {
    auto seed = store::seedFrom(text);
    if (!seed) throw CLI::ValidationError("--seed", seed.error().message);
    options.seed = seed->seed;
    options.seedText = std::move(seed->text);
}

world::ChunkArea parseArea(const std::string& text) {
    const auto n = parseNumbers(text, 4, "--area: expected X0,Y0,X1,Y1 in chunks");
    for (const double v : n) {
        if (v != static_cast<double>(static_cast<std::int64_t>(v)) || v < world::kMinChunk ||
            v > world::kMaxChunk + 1.0) {
            throw CLI::ValidationError("--area", fmt::format("chunk coordinates are integers from {} to {}",
                                                             world::kMinChunk, world::kMaxChunk));
        }
    }
    const world::ChunkArea area{static_cast<std::int32_t>(n[0]), static_cast<std::int32_t>(n[1]),
                                static_cast<std::int32_t>(n[2]), static_cast<std::int32_t>(n[3])};
    if (area.x1 <= area.x0 || area.y1 <= area.y0) {
        throw CLI::ValidationError("--area", fmt::format("\"{}\" is empty: the end X1,Y1 is excluded", text));
    }
    return area;
}

// An error unless the text can be a store::WorldLocation.
std::string isALocation(const std::string& text) {
    if (text.empty()) return "\"\" does not name a world";
    const bool isFile = store::worldLocation(text).kind == store::WorldLocation::Kind::File;
    return isFile ? isInAFolder(text) : std::string();
}

// Checks the ending of a file name, which selects the format.
CLI::Validator endingIn(const std::vector<std::string>& endings) {
    const auto check = [=](const std::string& text) -> std::string {
        const std::string name = CLI::detail::to_lower(text);
        const auto isItsEnd = [&](const std::string& ending) { return name.ends_with(ending); };
        if (endings.empty() || std::ranges::any_of(endings, isItsEnd)) return {};
        return fmt::format("\"{}\" does not end in {} (no other format is written)", text,
                           fmt::join(endings, " or "));
    };
    return CLI::Validator(check, "");
}

}  // namespace

CLI::Validator existingFolder() {
    const auto check = [](const std::string& text) {
        return text.empty() ? std::string() : CLI::ExistingDirectory(text);
    };
    return CLI::Validator(check, "");
}

CLI::Validator existingFile() {
    const auto check = [](const std::string& text) { return CLI::ExistingFile(text); };
    return CLI::Validator(check, "");
}

std::vector<double> parseNumbers(const std::string& text, std::size_t count, const std::string& form) {
    std::vector<double> numbers;
    const char *at = text.data(), *end = text.data() + text.size();
    for (bool hasMore = true; hasMore;) {
        double value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        hasMore = next != end && *next == ',';
        const bool isGood = error == std::errc() && value > -1e15 && value < 1e15 && (hasMore || next == end);
        if (!isGood) throw CLI::ValidationError(fmt::format("{}, got \"{}\"", form, text));
        numbers.push_back(value);
        at = next + 1;
    }
    if (numbers.size() != count) throw CLI::ValidationError(fmt::format("{}, got \"{}\"", form, text));
    return numbers;
}

base::Result<std::vector<std::int64_t>> parseWholeNumbers(const std::string& text, std::size_t count,
                                                          const std::string& form, std::int64_t low,
                                                          std::int64_t high) {
    std::vector<std::int64_t> whole;
    for (const double number : parseNumbers(text, count, form)) {
        if (number != std::floor(number) || number < static_cast<double>(low) ||
            number > static_cast<double>(high))
            return base::fail(base::ErrorCode::BadInput,
                              "{}: expected whole numbers within the world, got \"{}\"",
                              form.substr(0, form.find(':')), text);
        whole.push_back(static_cast<std::int64_t>(number));
    }
    return whole;
}

CLI::Validator numberFrom(double low, double high) {
    const auto check = [=](const std::string& text) -> std::string {
        double value = 0;
        const char* end = text.data() + text.size();
        const auto [next, error] = std::from_chars(text.data(), end, value);
        if (error == std::errc() && next == end && value >= low && value <= high) return {};
        return fmt::format("expected a number from {} to {}, got \"{}\"", low, high, text);
    };
    return CLI::Validator(check, fmt::format("{} to {}", low, high));
}

void addModeOption(CLI::App& command, std::string& mode) {
    std::vector<std::pair<std::string, std::string>> choices;
    for (const std::string_view name : game::kModeNames) choices.emplace_back(name, name);
    addChoice(command, "--mode", mode, choices, "Mode of the world from now on; a new one is creative");
}

void addWorldOptions(CLI::App& command, io::WorldOptions& options) {
    command
        .add_option_function<std::string>(
            "--seed", [&](const std::string& text) { parseSeed(text, options); },
            "Seed of the world: a whole number, also a negative one, or a text, whose xxHash64 is the seed")
        ->type_name("NUMBER|TEXT")
        ->default_str(std::to_string(io::WorldOptions::kDefaultSeed));
    command
        .add_option("--generator", options.generator,
                    fmt::format("Generator of the world, PACK:NAME of a content pack or one of these: {}",
                                fmt::join(gen::namesOf(gen::builtInGenerators()), ", ")))
        ->type_name("CHOICE")
        ->default_str(io::WorldOptions::kDefaultGenerator);
    const auto addHeight = [&](const char* name, std::optional<int>& height, const char* description) {
        command.add_option(name, height, description)
            ->type_name("Z")
            ->default_str("the generator's")
            ->check(numberFrom(world::kLowestBottom, world::kHighestTop));
    };
    addHeight("--bottom", options.heights.bottom, "The lowest layer of the world, a multiple of 16");
    addHeight("--top", options.heights.top, "The layer above the highest one of the world, a multiple of 16");
    addContentOption(command, options);
    command.add_option("--threads", options.threads, "Worker threads (default: one per CPU core)")
        ->check(numberFrom(1, 256));
}

void addContentOption(CLI::App& command, io::WorldOptions& options) {
    command
        .add_option(
            "--content", options.content,
            "Content packs: a name in $XDG_DATA_HOME/terrane/packs, or the path of a folder or zip file")
        ->type_name("PACK");
}

void addOutputOption(CLI::App& command, std::string& output, const std::vector<std::string>& endings,
                     const std::string& description) {
    writesFile(command.add_option("-o,--output", output, description))->check(endingIn(endings))->required();
}

void addResourcePackOption(CLI::App& command, std::string& folder) {
    command
        .add_option("--resource-pack", folder,
                    "Folder of PNG files named as textures, used in place of the built-in ones")
        ->check(existingFolder())
        ->type_name("DIR");
}

void addTraceOption(CLI::App& command, std::string& trace) {
    writesFile(command.add_option("--trace", trace, "Write a trace for Perfetto or chrome://tracing (JSON)"))
        ->configurable(false);
}

void addReportOption(CLI::App& command, std::string& report) {
    writesFile(command.add_option("--report", report,
                                  "Write counts of what was read and what was not understood (JSON)"));
}

void addWorldOption(CLI::App& command, io::SaveOptions& save, const std::string& description) {
    command.add_option("--world", save.world, description)
        ->check(CLI::Validator(isALocation, ""))
        ->type_name("NAME|FILE|URL");
}

void addWorldArgument(CLI::App& command, const std::string& name, std::string& world,
                      const std::string& description) {
    command.add_option(name, world, description)
        ->check(CLI::Validator(isALocation, ""))
        ->type_name("NAME|FILE|URL")
        ->required();
}

void addRecreateOption(CLI::App& command, io::SaveOptions& save) {
    auto* recreate = command.add_flag_callback(
        "--recreate", [&save] { save.regenerate = store::Regenerate::All; },
        "Copy the world and regenerate it; edits are gone");
    command
        .add_option_function<std::string>(
            "--regenerate",
            [&save](const std::string& text) {
                if (text != "keep-edits")
                    throw CLI::ValidationError("--regenerate",
                                               fmt::format("expected keep-edits, got \"{}\"", text));
                save.regenerate = store::Regenerate::AllButEdited;
            },
            "Copy the world and regenerate its chunks without edits, as after a change of the generator: "
            "keep-edits")
        ->type_name("CHOICE")
        ->excludes(recreate);
}

void addSaveGameOptions(CLI::App& command, io::SaveOptions& save) {
    addWorldOption(command, save, "World to play in; created if needed");
    addRecreateOption(command, save);
    command
        .add_option_function<std::string>(
            "--store-generated",
            [&save](const std::string& text) {
                if (text != "on" && text != "off")
                    throw CLI::ValidationError("--store-generated",
                                               fmt::format("expected one of on, off, got \"{}\"", text));
                save.storeGenerated = text == "on";
            },
            "Store chunks without edits too: loading is faster than generating. Not those of tall worlds "
            "of which only the upper part is made. The world keeps it: on, off")
        ->type_name("CHOICE");
}

base::Result<void> checkSaveOptions(const io::SaveOptions& save) {
    if (!save.world.empty()) return {};
    if (save.regenerate != store::Regenerate::None)
        return base::fail(base::ErrorCode::BadInput, "--recreate and --regenerate require --world");
    if (save.storeGenerated)
        return base::fail(base::ErrorCode::BadInput, "--store-generated requires --world");
    return {};
}

void addAreaOption(CLI::App& command, std::optional<world::ChunkArea>& area) {
    command
        .add_option_function<std::string>(
            "--area", [&](const std::string& text) { area = parseArea(text); }, "Chunks, the end excluded")
        ->type_name("X0,Y0,X1,Y1");
}

void addAreaOptions(CLI::App& command, AreaOptions& options, int maxRadius, const std::string& description) {
    auto* radius =
        command.add_option("--radius", options.radius, description)->check(numberFrom(0, maxRadius));
    addAreaOption(command, options.area);
    command.get_option("--area")->excludes(radius);
}

std::optional<world::ChunkArea> areaOf(const AreaOptions& options) {
    if (options.area || !options.radius) return options.area;
    const int r = *options.radius;
    return world::ChunkArea{-r, -r, r + 1, r + 1};
}

}  // namespace terrane::app
