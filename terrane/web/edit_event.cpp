#include "terrane/web/edit_event.h"

#include <nlohmann/json.hpp>
#include <set>

namespace terrane::web {
namespace {

constexpr std::size_t kMaxBoxes = 200;

// A square of 2^shift chunks of a level along each side.
struct Square {
    std::int32_t x = 0, y = 0;  // in units of the square
    std::uint8_t level = 0;

    auto operator<=>(const Square&) const = default;
};

std::set<Square> squaresOf(std::span<const world::ChunkPos> chunks, int shift) {
    std::set<Square> squares;
    for (const world::ChunkPos chunk : chunks)
        squares.insert({chunk.x >> shift, chunk.y >> shift, chunk.level});
    return squares;
}

}  // namespace

std::string editEvent(std::uint64_t number, std::span<const world::ChunkPos> chunks) {
    int shift = 0;
    std::set<Square> squares = squaresOf(chunks, shift);
    while (squares.size() > kMaxBoxes) squares = squaresOf(chunks, ++shift);
    nlohmann::json boxes = nlohmann::json::array();
    for (const Square& square : squares) {
        const std::int64_t width = std::int64_t{world::kChunkSize} << (square.level + shift);
        boxes.push_back({{"level", square.level},
                         {"x0", square.x * width},
                         {"y0", square.y * width},
                         {"x1", (square.x + 1) * width - 1},
                         {"y1", (square.y + 1) * width - 1}});
    }
    return nlohmann::json{{"number", number}, {"boxes", std::move(boxes)}}.dump();
}

}  // namespace terrane::web
