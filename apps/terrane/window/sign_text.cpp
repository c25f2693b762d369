#include "apps/terrane/window/sign_text.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "apps/terrane/window/line_of_sight.h"
#include "apps/terrane/window/screen_projection.h"
#include "terrane/world/sign.h"

namespace terrane::app {
namespace {

using world::BlockPos;

constexpr std::size_t kMaxSigns = 64;
constexpr double kFadeFrom = 20;      // blocks
constexpr double kAbove = 1.0 / 128;  // blocks between board and letters

glm::dvec3 cornerOf(BlockPos pos) {
    return {pos.x, pos.y, pos.z};
}

// Values shared by all letters of a sign.
struct Board {
    BlockPos pos;
    world::SignPlane plane;        // in the world
    glm::dvec3 right{0}, down{0};  // of length 1
};

ImVec2 imVec(const glm::vec2& v) {
    return {v.x, v.y};
}

struct Pen {
    const game::Session& session;
    const ScreenProjection& projection;
    glm::dvec3 eye;
    ImU32 color;
};

// Draws a letter; its upper left corner and size are in blocks on the board.
void drawGlyph(const Pen& pen, const Board& board, const ImFontGlyph& glyph, glm::dvec2 at, double scale) {
    const auto point = [&](double x, double y) {
        return board.plane.topLeft + board.right * (at.x + x * scale) + board.down * (at.y + y * scale) +
               board.plane.normal * kAbove;
    };
    const double x0 = double{glyph.X0}, x1 = double{glyph.X1}, y0 = double{glyph.Y0}, y1 = double{glyph.Y1};
    const glm::dvec3 middle = point((x0 + x1) / 2, (y0 + y1) / 2);
    if (!isInSight(pen.session.world(), pen.session.blocks(), pen.eye, middle, board.pos)) return;
    const std::array corners{pen.projection.at(point(x0, y0)), pen.projection.at(point(x1, y0)),
                             pen.projection.at(point(x1, y1)), pen.projection.at(point(x0, y1))};
    if (!std::ranges::all_of(corners, [](const auto& corner) { return corner.has_value(); })) return;
    ImGui::GetBackgroundDrawList()->AddImageQuad(ImGui::GetIO().Fonts->TexID, imVec(*corners[0]),
                                                 imVec(*corners[1]), imVec(*corners[2]), imVec(*corners[3]),
                                                 {glyph.U0, glyph.V0}, {glyph.U1, glyph.V0},
                                                 {glyph.U1, glyph.V1}, {glyph.U0, glyph.V1}, pen.color);
}

void drawLine(const Pen& pen, const Board& board, std::size_t number, const std::string& text) {
    const auto characters = world::charactersOf(text);
    if (!characters || characters->empty()) return;
    const ImFont& font = *ImGui::GetFont();
    std::vector<const ImFontGlyph*> glyphs;
    double width = 0;
    for (const char32_t c : *characters) {
        glyphs.push_back(
            font.FindGlyph(c <= IM_UNICODE_CODEPOINT_MAX ? static_cast<ImWchar>(c) : ImWchar{'?'}));
        width += double{glyphs.back()->AdvanceX};
    }
    const world::SignLine line = world::lineOn(board.plane, number, width / double{font.FontSize});
    const double scale = line.height / double{font.FontSize};
    double left = line.left;
    for (const ImFontGlyph* glyph : glyphs) {
        if (glyph->Visible) drawGlyph(pen, board, *glyph, {left, line.top}, scale);
        left += double{glyph->AdvanceX} * scale;
    }
}

}  // namespace

std::vector<BlockPos> signsNear(const game::Session& session, const glm::dvec3& point) {
    const glm::ivec3 low = glm::ivec3(glm::floor(point - kSignDistance)) >> 4;
    const glm::ivec3 high = glm::ivec3(glm::floor(point + kSignDistance)) >> 4;
    std::vector<BlockPos> signs;
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
            const world::ChunkPtr chunk = session.world().maybeChunkAt({x, y});
            if (!chunk) continue;
            for (const world::BlockIndex index : chunk->blocksWithBlockEntityData())
                if (world::holdsText(session.blocks().type(chunk->block(index))))
                    signs.push_back(world::blockPos({x, y}, index));
        }
    const auto distance = [&](BlockPos pos) { return glm::distance(cornerOf(pos) + 0.5, point); };
    std::erase_if(signs, [&](BlockPos pos) { return distance(pos) > kSignDistance; });
    std::ranges::sort(signs, {}, distance);
    if (signs.size() > kMaxSigns) signs.resize(kMaxSigns);
    return signs;
}

void drawSigns(const Screen& screen, const render::Camera& camera, const game::Session& session,
               const std::vector<BlockPos>& signs) {
    const ScreenProjection projection({screen.width, screen.height}, camera);
    for (const BlockPos pos : signs) {
        const world::BlockType& type = session.blocks().type(session.world().block(pos));
        const world::BlockEntityData* data = session.world().blockEntityData(pos);
        auto plane = world::signPlane(type, session.world().blockState(pos));
        if (!data || !plane || !world::holdsText(type)) continue;
        const auto text = world::decodeSign(*data);
        plane->topLeft += cornerOf(pos);
        const glm::dvec3 toEye = camera.position - plane->topLeft;
        const double distance = glm::length(toEye);
        if (!text || glm::dot(toEye, plane->normal) <= 0 || distance > kSignDistance) continue;
        const double share = glm::min(1.0, (kSignDistance - distance) / (kSignDistance - kFadeFrom));
        const Pen pen{session, projection, camera.position,
                      IM_COL32(24, 16, 8, static_cast<int>(230 * share))};
        const Board board{pos, *plane, glm::normalize(plane->right), glm::normalize(plane->down)};
        for (std::size_t line = 0; line < text->size(); ++line) drawLine(pen, board, line, (*text)[line]);
    }
}

}  // namespace terrane::app
