#include "apps/terrane/window/hud/name_tags.h"

#include <imgui.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

#include "apps/terrane/window/hud/overlay.h"
#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/ui_style.h"
#include "terrane/world/blocks/sign.h"

namespace terrane::app {

namespace {

constexpr double kBeforePoint = 1.0 / 128;  // the surface that holds the point does not hide it

bool hidesWhatIsBehind(const world::BlockRegistry& blocks, const world::RayHit& hit, world::BlockId id) {
    const world::BlockType& type = blocks.type(id);
    if (type.shape == world::Shape::Model) return true;
    if (type.shape != world::Shape::Cube) return false;
    const bool isClear = type.opacity == 0;  // such as glass with transparent panes
    return !isClear && blocks.materials()[type.material[hit.face]].alpha != world::AlphaMode::Blend;
}

}  // namespace

bool isInSight(const world::World& world, const world::BlockRegistry& blocks, const glm::dvec3& eye,
               const glm::dvec3& point, std::optional<world::BlockPos> own) {
    constexpr int kMostPassed = 24;
    constexpr double kStep = 0.25;  // blocks; a clear cell is left in several steps
    const glm::dvec3 way = point - eye, ahead = glm::normalize(way);
    double from = 0, left = glm::length(way) - kBeforePoint;
    for (int passed = 0; passed < kMostPassed && left > 0; ++passed) {
        const auto hit = world::castRay(world, blocks, {eye + ahead * from, ahead}, left);
        if (!hit || hit->block == own) return true;
        if (hidesWhatIsBehind(blocks, *hit, world.block(hit->block))) return false;
        const double step = hit->distance + kStep;
        from += step;
        left -= step;
    }
    return left <= 0;
}

namespace {

constexpr double kOverHead = world::kCharacterHeight - world::kEyeHeight + 0.15;  // blocks over the eyes
// Names up to kFullSize blocks away have full size; the size falls to kLeastSize at kNameDistance.
constexpr double kFullSize = 6;
constexpr float kLeastSize = 0.6f;
constexpr double kFadesFrom = 36;  // blocks

// 1 up to `from` blocks, 0 at kNameDistance.
float nearness(double distance, double from) {
    return static_cast<float>(glm::clamp((kNameDistance - distance) / (kNameDistance - from), 0.0, 1.0));
}

void drawName(ImDrawList& draw, const ShownName& shown) {
    const std::string& name = shown.tag->name;
    const char* end = name.data() + name.size();
    const ImFont& font = *ImGui::GetFont();
    const float height = shown.size * ImGui::GetFontSize(), pad = 3 * uiScale() * shown.size;
    const ImVec2 size = font.CalcTextSizeA(height, FLT_MAX, 0, name.data(), end);
    const ImVec2 corner{shown.at.x - size.x / 2, shown.at.y - size.y - pad};
    const auto faded = [&](int alpha) { return static_cast<int>(shown.alpha * static_cast<float>(alpha)); };
    draw.AddRectFilled({corner.x - 2 * pad, corner.y - pad},
                       {corner.x + size.x + 2 * pad, corner.y + size.y + pad},
                       IM_COL32(10, 12, 16, faded(130)), 2 * pad);
    draw.AddText(&font, height, corner, IM_COL32(255, 255, 255, faded(255)), name.data(), end);
}

}  // namespace

std::vector<ShownName> shownNames(const Screen& screen, const render::Camera& camera,
                                  std::span<const NameTag> names, const NamesView& view) {
    const ScreenProjection projection({screen.width, screen.height}, camera);
    struct Near {
        double distance;
        const NameTag* tag;
    };
    std::vector<Near> near;
    for (const NameTag& tag : names) {
        const double distance = glm::distance(tag.eyes, camera.position);
        if (distance < kNameDistance && distance > 0) near.push_back({distance, &tag});
    }
    std::ranges::stable_sort(near, {}, &Near::distance);
    if (near.size() > kMostNames) near.resize(kMostNames);
    std::vector<ShownName> shown;
    for (auto it = near.rbegin(); it != near.rend(); ++it) {
        const auto at = projection.at(it->tag->eyes + glm::dvec3(0, 0, kOverHead));
        if (!at || at->x < 0 || at->x > screen.width || at->y < 0 || at->y > screen.height) continue;
        if (!isInSight(view.world, view.blocks, camera.position, it->tag->eyes)) continue;
        shown.push_back({it->tag, *at, glm::mix(kLeastSize, 1.0f, nearness(it->distance, kFullSize)),
                         nearness(it->distance, kFadesFrom)});
    }
    return shown;
}

void drawNames(const Screen& screen, const render::Camera& camera, std::span<const NameTag> names,
               const NamesView& view) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    for (const ShownName& shown : shownNames(screen, camera, names, view)) drawName(draw, shown);
}

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
                if (world::isSign(session.blocks().type(chunk->block(index))))
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
        if (!data || !plane || !world::isSign(type)) continue;
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
