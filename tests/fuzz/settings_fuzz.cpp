// libFuzzer: any text as settings.toml, and changes by the player. A readable file stays readable after the
// changes, with their values.
#include "apps/terrane/settings.h"

#include <toml++/toml.h>

#include "apps/terrane/graphics_options.h"
#include "apps/terrane/options.h"
#include "apps/terrane/window/settings/key_bindings.h"
#include "tests/fuzz/fuzz_folder.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace terrane;
using app::SettingValues;
using fuzz::FuzzInput;

// Options of `terrane play`, made once: that takes longer than the rest.
struct PlayFlags {
    CLI::App command;
    app::GraphicsOptions graphics;
    io::WorldOptions world;
    io::SaveOptions save;

    PlayFlags() {
        app::addWorldOptions(command, world);
        app::addSaveGameOptions(command, save);
        app::addGraphicsOptions(command, graphics, "auto");
    }
};

base::Result<void> readSettings(const std::filesystem::path& file) {
    static PlayFlags flags;
    flags.command.clear();
    flags.graphics.choices = {};
    return app::applySettings(file, flags.command, render::namesOfPreset());
}

// Values before and after a change.
std::pair<SettingValues, SettingValues> changesFrom(FuzzInput& input) {
    static const std::vector<std::pair<std::string, std::vector<std::string>>> kValues = {
        {"view-distance", {"8", "32"}},        {"clouds", {"on", "off"}},
        {"preset", {"low", "high"}},           {"resource-pack", {"", "/"}},
        {"merging", {"none", "lines"}},        {"distance-fog", {"on", "off"}},
        {"mesh-section-height", {"16", "64"}},
    };
    SettingValues before, after;
    for (const auto& [name, values] : kValues) {
        const std::uint8_t choice = input.byte();
        if (choice & 1) before[name] = values[choice >> 1 & 1];
        if (choice & 4) after[name] = values[choice >> 3 & 1];
    }
    return {before, after};
}

void requireValues(const std::filesystem::path& file, const SettingValues& before,
                   const SettingValues& after) {
    const toml::table table = toml::parse(fuzz::readWhole(file));
    for (const auto& [name, value] : after) {
        const auto old = before.find(name);
        if (old != before.end() && old->second == value) continue;
        fuzz::require(table[name].value<std::string>() == value);
    }
    for (const auto& [name, value] : before)
        if (!after.contains(name)) fuzz::require(!table.contains(name));
}

// Key bindings survive writing and reading again.
void requireKeys(std::string_view text) {
    const auto keys = app::keyBindingsFrom(text);
    if (!keys) return fuzz::requireReason(keys.error());
    const auto again = app::keyBindingsFrom(app::textOf(*keys));
    fuzz::require(again && *again == *keys);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    FuzzInput input(data, size);
    const auto [before, after] = changesFrom(input);
    const std::filesystem::path file = fuzz::fuzzFolder() / "settings.toml";
    const std::string text(input.restAsText());
    requireKeys(text);
    fuzz::writeWhole(file, text);
    const auto read = readSettings(file);
    if (!read) fuzz::requireReason(read.error());
    const auto written = app::writeChanges(file, before, after, render::namesOfPreset());
    if (!written) fuzz::requireReason(written.error());
    if (!read) return 0;
    fuzz::require(written.has_value());
    const auto again = readSettings(file);
    fuzz::require(again.has_value());
    if (before != after) requireValues(file, before, after);
    return 0;
}
