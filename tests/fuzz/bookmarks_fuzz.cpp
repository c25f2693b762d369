// libFuzzer: any text as bookmarks. What is read must come back when it is written.
#include "apps/terrane/window/bookmarks.h"

#include "tests/fuzz/fuzz_folder.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terrane;
    const std::filesystem::path file = fuzz::fuzzFolder() / app::kBookmarksFile;
    fuzz::writeWhole(file, fuzz::FuzzInput(data, size).restAsText());
    const auto bookmarks = app::readBookmarks(file);
    if (!bookmarks) {
        fuzz::requireReason(bookmarks.error());
        return 0;
    }
    for (const render::Camera& camera : *bookmarks) {
        const auto back = app::cameraFrom(app::textOf(camera));
        fuzz::require(back && back->position == camera.position && back->yaw == camera.yaw);
    }
    return 0;
}
