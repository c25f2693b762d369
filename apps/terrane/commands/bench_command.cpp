// terrane bench: makes all measurements of docs/performance.md in one run. tools/bench_report.py makes tables
// and plots from the results.
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <system_error>

#include "apps/terrane/bench/bench_runner.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/graphics_options.h"
#include "apps/terrane/options.h"
#include "apps/terrane/output_files.h"
#include "terrane/base/digest.h"
#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/base/machine.h"
#include "terrane/base/platform.h"
#include "terrane/base/process.h"
#include "terrane/base/text.h"

namespace terrane::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct BenchOptions {
    std::string output;
    std::vector<std::string> only;
    bool isQuick = false, resumes = false, lists = false, copiesMemory = false;
    std::optional<std::string> size;
    std::optional<int> viewDistance, frames, runs, gpuMemory;
    bool anyFailed = false;  // of the last run
};

std::vector<std::string> tableNames() {
    std::vector<std::string> names;
    for (const CellGroup& group : planGroups({})) names.push_back(group.name);
    return names;
}

// Facts about the program and the graphics driver, from `terrane info` in its own process.
base::Result<json> programInfo(const fs::path& program, const fs::path& work) {
    auto end =
        TERRANE_TRY(base::runChild({program.string(), "info", "--json"}, {work, work / "messages.txt"}));
    json info = json::parse(end.output, nullptr, false);
    if (end.exitCode != 0 || !info.is_object()) return base::fail("terrane info --json failed");
    if (info["graphics"].contains("error"))
        return base::fail("{}", info["graphics"]["error"].get<std::string>());
    return info;
}

BenchSettings settingsOf(const BenchOptions& options, const json& graphics) {
    BenchSettings settings = options.isQuick ? quickSettings() : BenchSettings();
    settings.isSoftware = graphics["software"];
    settings.maxSamples = graphics["max_samples"];
    // A graphics card draws hundreds of frames per second.
    if (!settings.isSoftware) settings.frames *= 20;
    settings.size = options.size.value_or(settings.size);
    if (options.viewDistance) settings.viewDistance = settings.farthest = *options.viewDistance;
    settings.frames = options.frames.value_or(settings.frames);
    settings.runs = options.runs.value_or(settings.runs);
    return settings;
}

// Everything that results depend on: the first line of the results. A resumed run must have the same.
base::Result<json> aboutRun(const BenchSettings& settings, const json& info, const fs::path& program) {
    const auto bytes = base::readFile(program, std::size_t{1} << 30);  // with debug information
    if (!bytes) return tl::unexpected(bytes.error());
    base::Digest digest;
    digest.update(*bytes);
    const base::Machine machine = base::describeMachine();
    json about = {{"processor", machine.cpuName},
                  {"processors", machine.cpuCount},
                  {"memory", fmt::format("{:.0f} GB", machine.memoryBytes / 1e9)},
                  {"system", machine.system},
                  {"compiler", machine.compiler},
                  {"assertions", machine.hasAssertions ? "on" : "off"}};
    about["program"] = "terrane " + info["version"].get<std::string>();
    about["digest_of_the_program"] = digest.hex();
    about["instruction_sets"] = info["simd"];
    about["renderer"] = info["graphics"]["renderer"];
    about["OpenGL"] = info["graphics"]["version"];
    about["software_renderer"] = settings.isSoftware;
    about["most_samples"] = settings.maxSamples;
    about["view_distance"] = settings.viewDistance;
    about["farthest_view_distance"] = settings.farthest;
    about["picture"] = settings.size;
    about["frames_of_a_run"] = settings.frames;
    about["seconds_of_a_flight"] = settings.flightSeconds;
    about["runs_of_each_measurement"] = settings.runs;
    about["quick"] = settings.isQuick;
    return about;
}

// All groups if none are named.
std::vector<CellGroup> chosenGroups(const BenchSettings& settings, const std::vector<std::string>& only) {
    std::vector<CellGroup> groups = planGroups(settings);
    if (!only.empty())
        std::erase_if(groups,
                      [&](const CellGroup& group) { return std::ranges::count(only, group.name) == 0; });
    return groups;
}

// Prints the settings and each table with its command lines; one JSON value per line.
void printPlan(const json& about, const std::vector<CellGroup>& groups) {
    std::cout << json{{"settings", about}}.dump() << '\n';
    for (const CellGroup& group : groups) {
        json cells = json::array();
        for (const Cell& cell : uniqueCells({group})) cells.push_back(cell.arguments);
        std::cout << json{{"table", group.name}, {"cells", cells}}.dump() << '\n';
    }
}

// In rounds of one run of each cell, so that a slow minute does not affect all runs of a cell. A cell that
// failed is not run again.
base::Result<void> measureAll(const std::vector<Cell>& cells, int rounds, BenchRunner& runner,
                              ResultFile& results) {
    base::ProgressBar bar("measuring", cells.size() * static_cast<std::size_t>(rounds));
    std::size_t done = 0;
    for (int round = 1; round <= rounds; ++round)
        for (const Cell& cell : cells) {
            bar.set(++done);
            if (!results.failureOf(cell).empty()) continue;
            TERRANE_TRY(runner.measure(cell, round));
            if (const std::string_view failure = results.failureOf(cell); !failure.empty())
                base::logWarning("{}: {}", keyOf(cell), failure);
        }
    return {};
}

base::Result<fs::path> outputFolder(const std::string& output) {
    std::error_code error;
    fs::create_directories(output, error);
    const fs::path folder = error ? fs::path() : fs::canonical(output, error);
    if (error) return base::fail("{}: cannot be made: {}", output, error.message());
    return folder;
}

base::Result<void> bench(BenchOptions& options) {
    const fs::path program = base::platform::programFile();
    auto folder = TERRANE_TRY(options.lists ? fs::temp_directory_path() : outputFolder(options.output));
    const auto work = TERRANE_TRY(base::TemporaryFolder::make(folder, ".terrane-bench-"));
    auto info = TERRANE_TRY(programInfo(program, work.path()));
    const BenchSettings settings = settingsOf(options, info["graphics"]);
    const std::vector<CellGroup> groups = chosenGroups(settings, options.only);
    auto about = TERRANE_TRY(aboutRun(settings, info, program));
    if (options.gpuMemory) about["gpu_memory"] = *options.gpuMemory;
    if (options.lists) {
        printPlan(about, groups);
        return {};
    }

    const fs::path path = folder / "results.jsonl";
    auto results = TERRANE_TRY(options.resumes && fs::exists(path) ? ResultFile::resume(path, about)
                                                                   : ResultFile::create(path, about));
    const std::vector<Cell> cells = uniqueCells(groups);
    base::logInfo("{} tables, {} measurements of {} runs each", groups.size(), cells.size(), settings.runs);
    Arguments drawOptions = {"--horizon", "0"};  // the thesis measured chunks only
    if (options.gpuMemory)
        drawOptions.insert(drawOptions.end(), {"--gpu-memory", std::to_string(*options.gpuMemory)});
    BenchRunner runner(program, work.path(), drawOptions, results);
    TERRANE_TRY(measureAll(cells, settings.runs, runner, results));
    options.anyFailed = results.failureCount() > 0;
    base::logInfo("{} measurements, {} failed: {}", cells.size(), results.failureCount(), path.string());
    return {};
}

base::Result<void> runBench(BenchOptions& options) {
    if (options.copiesMemory) {
        std::cout << json{{"bytes_per_second", base::memoryCopySpeed()}}.dump() << '\n';
        return {};
    }
    if (options.output.empty() && !options.lists)
        return base::fail("bench needs --output: the folder for its results");
    return bench(options);
}

void addSettings(CLI::App& command, BenchOptions& options) {
    command
        .add_option_function<std::string>(
            "--size",
            [&options](const std::string& text) {
                const glm::ivec2 size = parseSize(text);
                options.size = fmt::format("{}x{}", size.x, size.y);
            },
            "Image size in pixels (default: 1920x1080, quick 320x180)")
        ->type_name("WxH");
    command.add_option("--view-distance", options.viewDistance, "In chunks (default: 32, quick 8)")
        ->check(numberFrom(1, 64));
    addGpuMemoryOption(command, options.gpuMemory);
    command
        .add_option("--frames", options.frames,
                    "Frames of a run (default: 9, quick 3; × 20 on a graphics card)")
        ->check(numberFrom(1, 100000));
    command.add_option("--runs", options.runs, "Runs of each measurement (default: 3, quick 1)")
        ->check(numberFrom(1, 1000));
}

}  // namespace

CommandEntry addBench(CLI::App& app) {
    auto options = std::make_shared<BenchOptions>();
    CLI::App* command =
        app.add_subcommand("bench", "Measure, for the tables that tools/bench_report.py makes");
    writesFolder(
        command->add_option("-o,--output", options->output, "Folder for results.jsonl; created if needed"));
    const auto isTable = [](const std::string& text) -> std::string {
        const std::vector<std::string> names = tableNames();
        return std::ranges::find(names, text) != names.end() ? "" : base::expectedOneOf(names, text);
    };
    command
        ->add_option("--only,TABLE", options->only,
                     fmt::format("Only what these tables need: {}", fmt::join(tableNames(), ", ")))
        ->delimiter(',')
        ->check(CLI::Validator(isTable, ""))
        ->type_name("TABLE");
    command->add_flag("--quick", options->isQuick,
                      "Less of everything: some minutes without a graphics card");
    command->add_flag("--resume", options->resumes, "Continue with the results in the folder");
    command->add_flag("--list", options->lists,
                      "Print settings and command lines as JSON lines, measure nothing");
    addSettings(*command, *options);
    command->add_flag("--memory-copy", options->copiesMemory, "")->group("");
    return {command, [options] { return runBench(*options); },
            [options] { return options->anyFailed ? 1 : 0; }};
}

}  // namespace terrane::app
