// libFuzzer: any bytes as content packs: zip files, archives of servers, and their texts (docs/packs.md).
#include "terrane/pack/content.h"
#include "terrane/pack/pack_files.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace terrane;

constexpr const char* kInfo = "format = 1\nname = \"p\"\n";

void load(pack::PackFiles files) {
    auto read = pack::makePack(std::move(files), "p");
    if (!read) return fuzz::requireReason(read.error());
    if (const auto content = pack::loadContent({std::move(*read)}); !content)
        fuzz::requireReason(content.error());
}

// An accepted pack survives the archive.
void sendAgain(const pack::Pack& read) {
    const auto again = pack::packOf(pack::archiveOf(read), "again");
    fuzz::require(again && again->files == read.files);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terrane;
    if (size == 0) return 0;
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    switch (data[0] % 5) {
        case 0:
            if (auto files = pack::readZipBytes(text, "p.zip"))
                if (const auto read = pack::makePack(std::move(*files), "p.zip")) sendAgain(*read);
            break;
        case 1:
            if (const auto read = pack::packOf(std::as_bytes(std::span(text)), "p")) sendAgain(*read);
            break;
        case 2:
            if (const auto read = pack::makePack({{"pack.toml", std::string(text)}}, "p"); !read)
                fuzz::requireReason(read.error());
            break;
        case 3:
            load({{"pack.toml", kInfo}, {"blocks.toml", std::string(text)}});
            break;
        default:
            load({{"pack.toml", kInfo}, {"textures/a.png", std::string(text)}});
    }
    return 0;
}
