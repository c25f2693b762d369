// libFuzzer: any text as bookmarks. What is read must come back when it is written.
#include "terrane/game/bookmarks.h"

#include "terrane/game/pose_text.h"
#include "tests/fuzz/fuzz_folder.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terrane;
    const std::filesystem::path file = fuzz::fuzzFolder() / "bookmarks.txt";
    fuzz::writeWhole(file, fuzz::FuzzInput(data, size).restAsText());
    const auto bookmarks = game::readBookmarks({file, {}});
    if (!bookmarks) {
        fuzz::requireReason(bookmarks.error());
        return 0;
    }
    for (const world::Pose& pose : *bookmarks) fuzz::require(game::poseFrom(game::textOf(pose)) == pose);
    return 0;
}
