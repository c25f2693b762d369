#include "apps/terrane/window/hud/overlay.h"

#include <imgui.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/terrane/window/hud/overlay_layout.h"
#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/ui_style.h"
#include "terrane/base/machine.h"
#include "terrane/game/block_interaction.h"
#include "terrane/render/shadow/shadow_volume.h"
#include "terrane/world/blocks/block_model.h"

namespace terrane::app {

ScreenProjection::ScreenProjection(glm::vec2 size, const render::Camera& camera) : size_(size) {
    const world::ChunkPos chunk = render::cameraChunk(camera);
    corner_ = {16.0 * chunk.x, 16.0 * chunk.y, 0};
    viewProjection_ = render::viewMatrices(camera, size.x / size.y).viewProjection;
}

glm::vec4 ScreenProjection::clip(const glm::dvec3& point) const {
    return viewProjection_ * glm::vec4(glm::vec3(point - corner_), 1.0f);
}

glm::vec2 ScreenProjection::onScreen(const glm::vec4& clip) const {
    return {(clip.x / clip.w * 0.5f + 0.5f) * size_.x, (0.5f - clip.y / clip.w * 0.5f) * size_.y};
}

std::optional<glm::vec2> ScreenProjection::at(const glm::dvec3& point) const {
    const glm::vec4 place = clip(point);
    if (place.w <= render::kNearPlane) return std::nullopt;
    return onScreen(place);
}

std::optional<std::pair<glm::vec2, glm::vec2>> ScreenProjection::line(const glm::dvec3& from,
                                                                      const glm::dvec3& to) const {
    constexpr float kNear = 2 * render::kNearPlane;
    glm::vec4 a = clip(from), b = clip(to);
    if (a.w < kNear && b.w < kNear) return std::nullopt;
    if (a.w < kNear) a = glm::mix(a, b, (kNear - a.w) / (b.w - a.w));
    if (b.w < kNear) b = glm::mix(b, a, (kNear - b.w) / (a.w - b.w));
    return std::pair(onScreen(a), onScreen(b));
}

namespace {

ImU32 withAlpha(int red, int green, int blue, float alpha) {
    return IM_COL32(red, green, blue, static_cast<int>(255 * glm::clamp(alpha, 0.0f, 1.0f)));
}

using Corners = std::array<std::optional<glm::vec2>, 4>;

// Projects a point of the world to the screen; none behind the camera.
std::optional<glm::vec2> projected(const Screen& screen, const render::Camera& camera, glm::dvec3 point) {
    return ScreenProjection({screen.width, screen.height}, camera).at(point);
}

Corners faceCorners(const Screen& screen, const render::Camera& camera, glm::dvec3 min, glm::dvec3 max,
                    int face) {
    const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    Corners corners;
    for (int k = 0; k < 4; ++k) {
        glm::dvec3 p = min;
        p[axis] = face % 2 == 1 ? max[axis] : min[axis];
        p[u] = k == 1 || k == 2 ? max[u] : min[u];
        p[v] = k >= 2 ? max[v] : min[v];
        corners[static_cast<std::size_t>(k)] = projected(screen, camera, p);
    }
    return corners;
}

}  // namespace

void drawTarget(const Screen& screen, const render::Camera& camera, const world::RayHit& target,
                const TargetView& view) {
    const auto& [world, blocks, isHighContrast] = view;
    const world::BlockType& type = blocks.type(world.block(target.block));
    constexpr double kGrow = 1.0 / 256;  // blocks: the outline is just outside of the faces
    const glm::dvec3 corner(target.block.x, target.block.y, target.block.z);
    const world::Box box = world::selectionBounds(type, world.blockState(target.block));
    const glm::dvec3 min = corner + glm::dvec3(box.min) - kGrow;
    const glm::dvec3 max = corner + glm::dvec3(box.max) + kGrow;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    for (int face = 0; face < world::kFaceCount; ++face) {
        const int axis = face / 2;
        const bool isSeen =
            face % 2 == 1 ? camera.position[axis] > max[axis] : camera.position[axis] < min[axis];
        const world::BlockPos next = world::adjacent(target.block, static_cast<world::Face>(face));
        const bool isCovered = type.shape == world::Shape::Cube && blocks.type(world.block(next)).opaqueCube;
        const Corners c = faceCorners(screen, camera, min, max, face);
        if (!isSeen || isCovered || !c[0] || !c[1] || !c[2] || !c[3]) continue;
        if (face == target.face)
            draw.AddQuadFilled(imVec(*c[0]), imVec(*c[1]), imVec(*c[2]), imVec(*c[3]),
                               isHighContrast ? IM_COL32(230, 159, 0, 110) : IM_COL32(255, 255, 255, 28));
        const auto outline = [&](ImU32 color, float width) {
            draw.AddQuad(imVec(*c[0]), imVec(*c[1]), imVec(*c[2]), imVec(*c[3]), color, width * uiScale());
        };
        outline(IM_COL32(0, 0, 0, isHighContrast ? 255 : 190), isHighContrast ? 5.0f : 1.5f);
        if (isHighContrast) outline(IM_COL32_WHITE, 2);
    }
}

render::Camera debugTopCamera(const render::Camera& camera, int viewDistance) {
    render::Camera above = camera;
    above.pitch = -89.9f;
    const double half = 16.0 * (viewDistance + 1);
    above.position.z += half / std::tan(glm::radians(double{camera.fieldOfView} / 2));
    return above;
}

void drawDebugTopView(const Screen& screen, const render::Camera& above, const render::Camera& camera,
                      float farBlocks, const std::optional<glm::vec3>& shadowLight) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const auto line = [&](glm::dvec3 a, glm::dvec3 b, ImU32 color) {
        const auto from = projected(screen, above, a), to = projected(screen, above, b);
        if (from && to) draw.AddLine(imVec(*from), imVec(*to), color, 2 * uiScale());
    };
    const glm::dvec3 ahead(render::lookDirection(camera)), right(render::rightDirection(camera));
    const glm::dvec3 up = glm::cross(right, ahead);
    const double tall = std::tan(glm::radians(double{camera.fieldOfView} / 2));
    const double wide = tall * double{screen.width / screen.height};
    const auto corner = [&](double x, double y) {
        return camera.position + (ahead + right * (x * wide) + up * (y * tall)) * double{farBlocks};
    };
    const std::array<glm::dvec3, 4> far = {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
    for (std::size_t k = 0; k < far.size(); ++k) {
        line(camera.position, far[k], IM_COL32(255, 220, 60, 255));
        line(far[k], far[(k + 1) % 4], IM_COL32(255, 220, 60, 255));
    }
    if (!shadowLight) return;
    const std::array<glm::dvec3, 8> map = render::nearShadowBox(camera, *shadowLight);
    constexpr ImU32 kShadowColor = IM_COL32(120, 190, 255, 255);
    for (std::size_t k = 0; k < map.size(); ++k) {
        for (const std::size_t axis : {1u, 2u, 4u})
            if ((k & axis) == 0) line(map[k], map[k | axis], kShadowColor);
    }
}

void drawCrosshair(OverlayLayout& layout) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const Screen& screen = layout.screen();
    const float x = std::floor(screen.width / 2), y = std::floor(screen.height / 2), r = 8 * uiScale();
    if (!layout.placeAt("crosshair", {{x - r, y - r}, {x + r, y + r}})) return;
    for (const auto& [color, thick] :
         {std::pair(IM_COL32(0, 0, 0, 120), 4.0f), {IM_COL32(255, 255, 255, 220), 2.0f}}) {
        draw.AddLine({x - r, y}, {x + r, y}, color, thick * uiScale());
        draw.AddLine({x, y - r}, {x, y + r}, color, thick * uiScale());
    }
}

void drawStatistics(OverlayLayout& layout, const Statistics& f) {
    ImGui::SetNextWindowBgAlpha(0.5f);
    if (!layout.beginWindow({.id = "statistics", .flags = OverlayLayout::kBare},
                            {.minHeight = 3 * ImGui::GetTextLineHeightWithSpacing()}))
        return;
    ImGui::PushTextWrapPos(std::min(400 * uiScale(), layout.widest()));
    const glm::dvec3& p = f.camera.position;
    ImGui::Text("%.1f frames/s (%.1f to %.1f), %d in the last second; drawn at %d %%", f.frames->now(),
                f.frames->min(), f.frames->max(), f.frames->lastSecond(), f.renderScale);
    ImGui::Text("x %.1f  y %.1f  z %.1f  yaw %.0f  pitch %.0f  time %.3f", p.x, p.y, p.z,
                double{f.camera.yaw}, double{f.camera.pitch}, f.timeDay);
    ImGui::Text("chunks: %zu active, %zu of %zu visible, %zu queued", f.activeChunks, f.progress.visible,
                f.progress.inView, f.queuedChunks);
    if (const std::string levels = stream::shownLevels(*f.tiles); !levels.empty())
        ImGui::Text("shown by level: %s; %zu to come", levels.c_str(), stream::missingTiles(*f.tiles));
    ImGui::Text("triangles: %zu opaque, %zu transparent, %zu shadow", f.frame.opaqueTriangles,
                f.frame.transparentTriangles, f.frame.shadowTriangles);
    ImGui::Text("MB: blocks %.1f, light %.1f; on the GPU quads %.1f, light %.1f, %.0f of %.0f",
                base::megabytes(f.memory.blocks), base::megabytes(f.memory.light),
                base::megabytes(f.memory.quads), base::megabytes(f.memory.lightOnGpu),
                base::megabytes(f.memory.onGpu), base::megabytes(f.memory.gpuBudget));
    for (const stream::TaskTime& task : f.tasks) {
        if (task.count == 0) continue;
        ImGui::Text("%s: %.0f us each, %zu", task.name, task.microseconds / static_cast<double>(task.count),
                    task.count);
    }
    for (const gpu::GpuTiming& pass : *f.passes)
        ImGui::Text("%s: %.2f ms", pass.name.c_str(), pass.milliseconds);
    ImGui::PopTextWrapPos();
    ImGui::End();
}

void drawProgress(OverlayLayout& layout, const stream::Progress& progress, const Texts& tr) {
    const float share =
        static_cast<float>(progress.visible) / static_cast<float>(std::max<std::size_t>(progress.inView, 1));
    ImGui::SetNextWindowBgAlpha(0.55f);
    if (!layout.beginWindow({.id = "progress", .flags = OverlayLayout::kBare},
                            {.alignX = 0.5f, .top = layout.screen().height - 118 * uiScale()}))
        return;
    ImGui::TextUnformatted(tr("Loading the world"));
    ImGui::ProgressBar(share, {240 * uiScale(), 8 * uiScale()}, "");
    ImGui::End();
}

void drawKeyHelp(OverlayLayout& layout, float share, const std::vector<KeyHelpLine>& lines) {
    const float row = ImGui::GetTextLineHeightWithSpacing();
    const float height = row * static_cast<float>(lines.size());
    ImGui::SetNextWindowBgAlpha(0.55f * share);
    if (!layout.beginWindow(
            {.id = "help", .flags = OverlayLayout::kBare},
            {.alignX = 0.5f, .top = layout.screen().height * 0.35f - height / 2, .minHeight = 3 * row}))
        return;
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, share);
    float column = 0;
    for (const KeyHelpLine& line : lines) column = std::max(column, ImGui::CalcTextSize(line.keys.c_str()).x);
    ImGui::PushTextWrapPos(layout.widest() - 2 * layout.margin());
    for (const KeyHelpLine& line : lines) {
        ImGui::TextUnformatted(line.keys.c_str());
        ImGui::SameLine(column + 24 * uiScale());
        ImGui::TextUnformatted(line.effect.c_str());
    }
    ImGui::PopTextWrapPos();
    ImGui::PopStyleVar();
    ImGui::End();
}

void drawMessage(OverlayLayout& layout, const std::string& message, float share) {
    const float pad = 6 * uiScale(), widest = std::max(1.0f, layout.widest() - 2 * pad);
    const ImVec2 size = ImGui::CalcTextSize(message.c_str(), nullptr, false, widest);
    const auto rect = layout.place("message", {.size = {size.x + 2 * pad, size.y + 2 * pad},
                                               .alignX = 0.5f,
                                               .top = layout.screen().height * 0.75f - pad,
                                               .minHeight = ImGui::GetFontSize() + 2 * pad});
    if (!rect) return;
    ImDrawList& draw = *ImGui::GetForegroundDrawList();
    const OverlayClip clip(draw, *rect);
    draw.AddRectFilled(rect->min, rect->max, withAlpha(10, 12, 16, 0.7f * share), pad);
    draw.AddText(nullptr, 0, {rect->min.x + pad, rect->min.y + pad}, withAlpha(255, 255, 255, share),
                 message.c_str(), nullptr, widest);
}

}  // namespace terrane::app
