#include "apps/terrane/maps/place_file.h"

#include <sstream>
#include <string>
#include <utility>

#include "terrane/base/files.h"

namespace terrane::app {
namespace {

// The map shows all places at once: 1,000 names of up to game::kMaxPlaceName bytes are 100 KB for a browser.
constexpr std::size_t kMaxPlaces = 1000, kMaxBytes = std::size_t{1} << 20;

}  // namespace

base::Result<std::vector<game::Place>> readPlaceFile(const std::filesystem::path& file) {
    std::vector<game::Place> places;
    if (file.empty()) return places;
    const auto text = TERRANE_TRY(base::readFile(file, kMaxBytes));
    std::istringstream in(text);
    int line = 0, unnamed = 0;
    for (std::string words; std::getline(in, words);) {
        ++line;
        if (words.find_first_not_of(" \t\r") == std::string::npos) continue;
        if (words.back() == '\r') words.pop_back();
        auto place = game::placeFrom(words);
        if (!place)
            return base::fail(base::ErrorCode::BadInput, "{}:{}: no place: expected X Y Z YAW PITCH NAME",
                              file.string(), line);
        if (places.size() == kMaxPlaces)
            return base::fail(base::ErrorCode::BadInput, "{}:{}: more than {} places", file.string(), line,
                              kMaxPlaces);
        if (place->name.empty()) place->name = std::to_string(++unnamed);
        places.push_back(std::move(*place));
    }
    return places;
}

}  // namespace terrane::app
