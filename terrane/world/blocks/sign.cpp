#include "terrane/world/blocks/sign.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>

#include "terrane/base/result.h"
#include "terrane/base/text.h"
#include "terrane/world/blocks/block_model.h"

namespace terrane::world {
namespace {

constexpr std::byte kSignVersion{1};
constexpr std::string_view kSignBehavior = "sign";

bool isControl(char32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0);
}

}  // namespace

std::optional<std::u32string> charactersOf(std::string_view utf8) {
    std::u32string characters;
    while (!utf8.empty()) {
        const base::CodePoint next = base::firstCodePoint(utf8);
        if (next.bytes == 0) return std::nullopt;
        characters.push_back(next.code);
        utf8.remove_prefix(next.bytes);
    }
    return characters;
}

std::size_t fittingBytes(std::string_view line) {
    std::size_t characters = 0;
    for (std::size_t at = 0; at < line.size(); ++at) {
        const bool isFirst = (static_cast<unsigned char>(line[at]) & 0xC0) != 0x80;
        if (isFirst && ++characters > kSignColumns) return at;
    }
    return line.size();
}

base::Result<void> checkSign(const SignText& text) {
    for (const std::string& line : text) {
        const auto characters = charactersOf(line);
        if (!characters) return base::fail(base::ErrorCode::BadInput, "a line of a sign is not UTF-8");
        if (characters->size() > kSignColumns)
            return base::fail(base::ErrorCode::BadInput, "a line of a sign has {} characters, at most {}",
                              characters->size(), kSignColumns);
        if (std::ranges::any_of(*characters, isControl))
            return base::fail(base::ErrorCode::BadInput, "a line of a sign has control characters");
    }
    return {};
}

BlockEntityData encodeSign(const SignText& text) {
    base::require(checkSign(text).has_value(), "encodeSign: a text that checkSign() rejects");
    BlockEntityData data{kSignVersion};
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (k > 0) data.push_back(std::byte{'\n'});
        const auto bytes = std::as_bytes(std::span(text[k]));
        data.insert(data.end(), bytes.begin(), bytes.end());
    }
    return data;
}

base::Result<SignText> decodeSign(const BlockEntityData& data) {
    if (data.empty() || data.size() > kMaxSignBytes || data[0] != kSignVersion)
        return base::fail(base::ErrorCode::Damaged, "{} bytes are no text of a sign", data.size());
    SignText text;
    std::size_t line = 0;
    for (std::size_t k = 1; k < data.size(); ++k) {
        const auto c = static_cast<char>(data[k]);
        if (c != '\n') {
            text[line] += c;
        } else if (++line == kSignLines) {
            return base::fail(base::ErrorCode::Damaged, "a sign has more than {} lines", kSignLines);
        }
    }
    if (line + 1 != kSignLines)
        return base::fail(base::ErrorCode::Damaged, "a sign has {} lines, expected {}", line + 1, kSignLines);
    TERRANE_TRY(checkSign(text));
    return text;
}

BlockBehavior signBehavior() {
    return {.name = std::string(kSignBehavior)};
}

bool isSign(const BlockType& type) {
    return std::ranges::any_of(type.behaviors, [](const BehaviorPtr& b) { return b->name == kSignBehavior; });
}

// A sign that faces +y has its text at -y; the others are that, turned.
std::optional<SignPlane> signPlane(const BlockType& type, std::uint16_t state) {
    if (!type.model) return std::nullopt;
    const std::vector<Box>& boxes = type.model->form(state).boxes;
    if (boxes.empty()) return std::nullopt;
    const int facing = state & type.model->stateMask & kStateFacing;
    constexpr std::array<glm::dvec3, 4> kLooks{{{0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {1, 0, 0}}};
    const glm::dvec3 ahead = kLooks[static_cast<std::size_t>(facing)], right(ahead.y, -ahead.x, 0);
    const auto alongRight = [&](const Box& box) {
        const glm::dvec3 size(box.max - box.min);
        return size.x * std::abs(right.x) + size.y * std::abs(right.y);
    };
    const Box& board = *std::ranges::max_element(
        boxes, {}, [&](const Box& box) { return alongRight(box) * double{box.max.z - box.min.z}; });
    const glm::dvec3 middle = (glm::dvec3(board.min) + glm::dvec3(board.max)) / 2.0;
    const glm::dvec3 half = (glm::dvec3(board.max) - glm::dvec3(board.min)) / 2.0;
    const double depth = half.x * std::abs(ahead.x) + half.y * std::abs(ahead.y);
    const double width = alongRight(board);
    return SignPlane{.topLeft = middle - ahead * depth - right * (width / 2) + glm::dvec3(0, 0, half.z),
                     .right = right * width,
                     .down = {0, 0, -2 * half.z},
                     .normal = -ahead};
}

SignLine lineOn(const SignPlane& plane, std::size_t number, double aspect) {
    constexpr double kMargin = 1.0 / 16, kFilled = 0.9;  // of a line's share of the height
    const double width = glm::length(plane.right) - 2 * kMargin;
    const double share = (glm::length(plane.down) - 2 * kMargin) / kSignLines;
    const double height = aspect * share * kFilled > width ? width / aspect : share * kFilled;
    return {.left = kMargin + (width - aspect * height) / 2,
            .top = kMargin + static_cast<double>(number) * share + (share - height) / 2,
            .height = height};
}

}  // namespace terrane::world
