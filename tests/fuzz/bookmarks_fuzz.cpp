// libFuzzer: any text as bookmarks, and as named places. Values survive writing and reading again.
#include "terrane/game/places.h"

#include "terrane/game/player_state.h"
#include "tests/fuzz/fuzz_folder.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terrane;
    const std::filesystem::path file = fuzz::fuzzFolder() / "bookmarks.txt";
    const std::string text(fuzz::FuzzInput(data, size).restAsText());
    fuzz::writeWhole(file, text);
    const std::vector<game::Place> places = game::placesFrom(text);
    fuzz::require(game::placesFrom(game::textOf(places)) == places);
    const auto bookmarks = game::readBookmarks({file, {}});
    if (!bookmarks) {
        fuzz::requireReason(bookmarks.error());
        return 0;
    }
    for (const world::Pose& pose : *bookmarks) fuzz::require(game::parsePose(game::textOf(pose)) == pose);
    return 0;
}
