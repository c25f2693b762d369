#include "apps/terrane/window/new_world_form.h"

#include <string_view>

#include "terrane/store/world_list.h"

namespace terrane::app {
namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpaces = " \t";
    const std::size_t first = text.find_first_not_of(kSpaces);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

}  // namespace

NewWorldForm newForm(const std::filesystem::path& folder, std::uint64_t randomSeed) {
    NewWorldForm form;
    form.name = store::freeWorldName(folder, "World");
    form.randomSeed = randomSeed;
    return form;
}

base::Result<WrittenSeed> seedOf(const NewWorldForm& form) {
    const std::string_view text = trimmed(form.seed);
    if (text.empty()) return WrittenSeed{form.randomSeed, ""};
    return seedFrom(text);
}

base::Result<ChosenWorld> worldOf(const NewWorldForm& form, const std::filesystem::path& folder) {
    const std::string name(trimmed(form.name));
    if (name.empty()) return base::fail(base::ErrorCode::BadInput, "a world needs a name");
    TERRANE_TRY(store::checkNewWorld(folder, name));
    auto seed = seedOf(form);
    if (!seed) return base::fail(base::ErrorCode::BadInput, "seed: {}", seed.error().message);
    return ChosenWorld{store::worldFile(folder, name), std::move(*seed), form.generator};
}

}  // namespace terrane::app
