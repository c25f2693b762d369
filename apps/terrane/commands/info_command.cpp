// terrane info: shows the version, the CPU's features, generators and the graphics driver.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/options.h"
#include "terrane/gen/cpu/kernels.h"
#include "terrane/gen/generators/catalogue.h"

namespace terrane::app {
namespace {

base::Result<void> printInfo(bool asJson) {
    const nlohmann::json info = {{"version", TERRANE_VERSION},
                                 {"processors", std::thread::hardware_concurrency()},
                                 {"simd", gen::simdTargets()},
                                 {"generators", gen::namesOf(gen::builtInGenerators())},
                                 {"graphics", graphicsInfo()}};
    if (asJson) {
        std::cout << info.dump() << '\n';
        return {};
    }
    fmt::print("terrane {}\nprocessors   {}\nsimd         {}\ngenerators   {}\n", TERRANE_VERSION,
               std::thread::hardware_concurrency(), fmt::join(gen::simdTargets(), " "),
               fmt::join(gen::namesOf(gen::builtInGenerators()), " "));
    for (const auto& [key, value] : info["graphics"].items()) {
        fmt::print("{:<24}{}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
    }
    return {};
}

}  // namespace

CommandEntry addInfo(CLI::App& app) {
    auto asJson = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("info", "Show the renderer, its limits and the CPU's features");
    command->add_flag("--json", *asJson, "Print as JSON");
    return {command, [asJson] { return printInfo(*asJson); }};
}

}  // namespace terrane::app
