#include "apps/terrane/window/hud/selection_tool.h"

#include <fmt/format.h>
#include <imgui.h>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <iterator>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/ui_style.h"
#include "apps/terrane/window/widgets.h"
#include "terrane/store/chunks/structure_file.h"
#include "terrane/world/ray_cast.h"

namespace terrane::app {

namespace {

using game::BuildOutcome;
using world::BlockBox;
using world::BlockPos;

constexpr double kAhead = 6;  // blocks to the cell in the air
constexpr const char* kNoBox = "no box is selected: left and right button set its corners";

// Each action with its key and its button of the panel, in rows of two.
struct ToolRow {
    ToolAction action;
    Key key;
    bool withControl;
    const char* label;
};
constexpr ToolRow kToolActions[] = {{ToolAction::Fill, Key::G, false, trLater("Fill (G)")},
                                    {ToolAction::Replace, Key::X, false, trLater("Replace (X)")},
                                    {ToolAction::Clear, Key::Delete, false, trLater("Clear (Del)")},
                                    {ToolAction::Shape, Key::U, false, trLater("Shape (U)")},
                                    {ToolAction::Copy, Key::C, true, trLater("Copy (Ctrl+C)")},
                                    {ToolAction::Paste, Key::V, true, trLater("Paste (Ctrl+V)")},
                                    {ToolAction::Turn, Key::R, false, trLater("Rotate (R)")},
                                    {ToolAction::Mirror, Key::F, false, trLater("Mirror (F)")},
                                    {ToolAction::Save, Key::S, true, trLater("Save (Ctrl+S)")},
                                    {ToolAction::Open, Key::O, true, trLater("Open (Ctrl+O)")}};

// Indexed by game::ShapeKind.
constexpr const char* kShapeNames[] = {trLater("box"), trLater("hollow"), trLater("walls"), trLater("sphere"),
                                       trLater("line")};
static_assert(std::size(kShapeNames) == static_cast<std::size_t>(game::ShapeKind::Count));

const char* nameOf(game::ShapeKind kind) {
    return kShapeNames[static_cast<std::size_t>(kind)];
}

game::ShapeKind nextShape(game::ShapeKind kind) {
    return static_cast<game::ShapeKind>((static_cast<std::size_t>(kind) + 1) % std::size(kShapeNames));
}

world::Ray lookRay(const BuildView& view) {
    return {view.pose.position, glm::dvec3(world::lookDirection(view.pose.yaw, view.pose.pitch))};
}

std::optional<world::RayHit> lookedAt(const BuildView& view) {
    return world::castRay(view.session.world(), view.session.blocks(), lookRay(view), game::kBuildReach);
}

// Why nothing changed.
std::string refusal(BuildOutcome::Result result) {
    using Result = BuildOutcome::Result;
    switch (result) {
        case Result::TooLarge:
            return fmt::format("too large: at most {} blocks, fewer on a server",
                               withCommas(world::kMaxStructureBlocks));
        case Result::OutOfWorld:
            return "it reaches above or below the world";
        case Result::NotLoaded:
            return "a part of it is not loaded: go closer";
        case Result::OutOfReach:
            return fmt::format("it is more than {:.0f} blocks away", game::kBuildReach);
        case Result::NotAllowed:
            return "you may not change a part of it";
        case Result::TooSoon:
            return "too many blocks in a short time: wait a moment";
        case Result::Refused:
            return "the rules of the world do not allow it";
        case Result::Sent:
            return "waiting for the server";
        default:
            return "there is nothing to build";
    }
}

std::string blocksText(std::int64_t count) {
    return withCommas(count) + (count == 1 ? " block" : " blocks");
}

}  // namespace

std::string outcomeText(std::string_view verb, const BuildOutcome& outcome) {
    if (outcome.result != BuildOutcome::Result::Done) return refusal(outcome.result);
    std::string text = fmt::format("{} {}", verb, blocksText(static_cast<std::int64_t>(outcome.changed)));
    if (outcome.skipped > 0)
        text += fmt::format("; {} of the lowest layer kept",
                            blocksText(static_cast<std::int64_t>(outcome.skipped)));
    return text;
}

std::string withCommas(std::int64_t number) {
    std::string text = std::to_string(number);
    for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
        text.insert(static_cast<std::size_t>(at), ",");
    return text;
}

BlockPos pointedAt(const BuildView& view, bool beforeBlock) {
    if (view.shift) {
        const glm::dvec3 feet =
            view.body ? view.body->min + glm::dvec3(0.5, 0.5, 0) * (view.body->max - view.body->min)
                      : view.pose.position;
        return world::blockOf(feet + glm::dvec3(0, 0, 1e-3));
    }
    if (const auto hit = lookedAt(view))
        return beforeBlock ? world::adjacent(hit->block, hit->face) : hit->block;
    const world::Ray ray = lookRay(view);
    return world::blockOf(ray.origin + ray.direction * kAhead);
}

bool SelectionTool::onKey(Key key, const BuildView& view) {
    if (isAsking()) {
        onKeyWhileAsking(key);
        return true;
    }
    if (key == Key::B && !view.control) {
        isActive_ = !isActive_;
        selection_.endPaste();
        return true;
    }
    if (!isActive_) return false;
    for (const ToolRow& row : kToolActions) {
        if (row.key != key || row.withControl != view.control) continue;
        act(row.action, view);
        return true;
    }
    return false;
}

bool SelectionTool::onButton(MouseButton button, const BuildView& view) {
    if (!isActive_ || button == MouseButton::Middle) return false;
    const bool isLeft = button == MouseButton::Left;
    if (selection_.isPasting()) {
        isLeft ? place(view) : selection_.endPaste();
        return true;
    }
    const BlockPos corner = pointedAt(view, false);
    isLeft ? selection_.setFirst(corner) : selection_.setSecond(corner);
    const BlockBox box = *selection_.box();
    message_ = fmt::format("{} corner {}, {}, {}; {}", isLeft ? "first" : "second", corner.x, corner.y,
                           corner.z, blocksText(box.blockCount()));
    return true;
}

bool SelectionTool::onWheel(int steps, const BuildView& view) {
    if (!isActive_ || !view.control) return false;
    using End = game::Selection::End;
    if (!selection_.box()) {
        message_ = kNoBox;
    } else if (selection_.moveEnd(view.shift ? End::Bottom : End::Top, steps,
                                  view.session.world().heights())) {
        const BlockBox box = *selection_.box();
        message_ = fmt::format("height {}, from {} to {}; {}", box.high.z - box.low.z + 1, box.low.z,
                               box.high.z, blocksText(box.blockCount()));
    }
    return true;
}

bool SelectionTool::close() {
    if (isAsking()) {
        asks_ = Asks::Nothing;
    } else if (selection_.isPasting()) {
        selection_.endPaste();
    } else if (isActive_) {
        isActive_ = false;
    } else {
        return false;
    }
    return true;
}

void SelectionTool::act(ToolAction action, const BuildView& view) {
    switch (action) {
        case ToolAction::Fill:
            return fill(view, view.hand, std::nullopt);
        case ToolAction::Clear:
            return fill(view, world::kAir, std::nullopt);
        case ToolAction::Replace:
            return replace(view);
        case ToolAction::Shape:
            selection_.setShape(nextShape(selection_.shapeKind()));
            message_ = fmt::format("shape: {}", nameOf(selection_.shapeKind()));
            return;
        case ToolAction::Copy:
            return copy(view);
        case ToolAction::Paste:
            return beginPaste();
        case ToolAction::Save:
            return askName();
        case ToolAction::Open:
            return askFile();
        case ToolAction::Turn:
        case ToolAction::Mirror:
            break;
    }
    if (!selection_.clipboard()) {
        message_ = "nothing is copied (Ctrl+C)";
    } else if (action == ToolAction::Turn) {
        selection_.turn(view.session.blocks());
        message_ = "rotated by 90 degrees";
    } else {
        selection_.mirror(view.session.blocks(), view.pose.yaw);
        message_ = "mirrored";
    }
}

void SelectionTool::fill(const BuildView& view, world::BlockId id, std::optional<world::BlockId> replaced) {
    const auto box = selection_.box();
    if (!box) {
        message_ = kNoBox;
        return;
    }
    const auto outcome =
        view.session.build({game::kLocalPlayer, game::FillBox{*box, id, 0, replaced, selection_.shape()}});
    message_ = outcomeText(replaced ? "replaced" : id == world::kAir ? "cleared" : "filled", outcome);
}

void SelectionTool::replace(const BuildView& view) {
    const auto hit = lookedAt(view);
    if (!hit) {
        message_ = "look at a block of the kind to be replaced";
        return;
    }
    fill(view, view.hand, view.session.world().block(hit->block));
}

void SelectionTool::copy(const BuildView& view) {
    const auto box = selection_.box();
    if (!box || box->blockCount() > world::kMaxStructureBlocks) {
        message_ = box ? refusal(BuildOutcome::Result::TooLarge) : "no box is selected";
        return;
    }
    selection_.setClipboard(world::copyBlocks(view.session.world(), view.session.blocks(), *box));
    message_ = "copied " + blocksText(box->blockCount());
}

void SelectionTool::beginPaste() {
    message_ =
        selection_.beginPaste() ? "left button: place, right button: cancel" : "nothing is copied (Ctrl+C)";
}

void SelectionTool::place(const BuildView& view) {
    const auto low = selection_.pasteCorner(pointedAt(view, true), view.session.world().heights());
    message_ = outcomeText(
        "placed",
        view.session.build({game::kLocalPlayer, game::PlaceStructure{selection_.clipboard(), *low}}));
}

void SelectionTool::askName() {
    if (!selection_.clipboard()) {
        message_ = "nothing is copied (Ctrl+C)";
        return;
    }
    asks_ = Asks::Name;
    takesFocus_ = true;
    name_ = {};
}

void SelectionTool::askFile() {
    files_ = store::structureNames(folder_);
    file_ = 0;
    if (files_.empty()) {
        message_ = fmt::format("there are no structures in {}", folder_.string());
    } else {
        asks_ = Asks::File;
    }
}

void SelectionTool::onKeyWhileAsking(Key key) {
    if (key == Key::Escape) asks_ = Asks::Nothing;
    if (key == Key::Enter) isAnswered_ = true;
    if (asks_ != Asks::File || files_.empty()) return;
    if (key == Key::Down) file_ = (file_ + 1) % files_.size();
    if (key == Key::Up) file_ = (file_ + files_.size() - 1) % files_.size();
}

// Handles Enter after the text of the same frame.
void SelectionTool::answer(const BuildView& view) {
    isAnswered_ = false;
    const Asks asked = std::exchange(asks_, Asks::Nothing);
    if (asked == Asks::Name) saveAs(name_.data());
    if (asked == Asks::File) open(files_[file_], view.session.blocks());
}

void SelectionTool::saveAs(const std::string& name) {
    const auto path = store::structurePath(folder_, name);
    const auto done = path ? store::writeStructure(*path, *selection_.clipboard())
                           : base::Result<void>(tl::unexpected(path.error()));
    message_ = done ? fmt::format("saved {}", path->string()) : done.error().message;
}

void SelectionTool::open(const std::string& name, const world::BlockRegistry& blocks) {
    const auto path = store::structurePath(folder_, name);
    auto structure =
        path ? store::readStructure(*path) : base::Result<world::Structure>(tl::unexpected(path.error()));
    if (!structure) {
        message_ = structure.error().message;
        return;
    }
    const std::vector<std::string> unknown = world::unknownNames(*structure, blocks);
    message_ = fmt::format("{}: {}", name, blocksText(structure->blockCount()));
    if (!unknown.empty())
        *message_ +=
            fmt::format("; {} kinds are unknown and shown as missing, {} first", unknown.size(), unknown[0]);
    selection_.setClipboard(std::move(*structure));
    selection_.beginPaste();
}

// Draws the selection tool: its panel, and the outlines of boxes and lines.

namespace {

// Orange and blue, which color-blind players can distinguish.
constexpr ImU32 kSelected = IM_COL32(255, 160, 40, 255);
constexpr ImU32 kPasted = IM_COL32(90, 180, 255, 255);

void drawEdge(const ScreenProjection& projection, const glm::dvec3& a, const glm::dvec3& b, ImU32 color) {
    const auto line = projection.line(a, b);
    if (!line) return;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.AddLine(imVec(line->first), imVec(line->second), IM_COL32(0, 0, 0, 140), 4 * uiScale());
    draw.AddLine(imVec(line->first), imVec(line->second), color, 2 * uiScale());
}

void drawBox(const ScreenProjection& projection, const BlockBox& box, double grow, ImU32 color) {
    const glm::dvec3 low = glm::dvec3(box.low.x, box.low.y, box.low.z) - grow;
    const glm::dvec3 high = glm::dvec3(box.high.x + 1.0, box.high.y + 1.0, box.high.z + 1.0) + grow;
    const auto corner = [&](unsigned k) {
        return glm::dvec3((k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                          (k & 4) != 0 ? high.z : low.z);
    };
    for (unsigned k = 0; k < 8; ++k)
        for (const unsigned axis : {1u, 2u, 4u})
            if ((k & axis) == 0) drawEdge(projection, corner(k), corner(k | axis), color);
}

// From the middle of the first block of a line to that of the last one.
void drawLineOf(const ScreenProjection& projection, const game::FillShape& shape, const BlockBox& box) {
    const auto end = [&](bool isTop) {
        return glm::dvec3(shape.fromHighX != isTop ? box.high.x : box.low.x,
                          shape.fromHighY != isTop ? box.high.y : box.low.y, isTop ? box.high.z : box.low.z) +
               0.5;
    };
    drawEdge(projection, end(false), end(true), kSelected);
}

// Of a box of any size: its corners may lie at both ends of the world.
std::string sizeText(const Texts& tr, const BlockBox& box) {
    const auto side = [](std::int32_t low, std::int32_t high) { return std::int64_t{high} - low + 1; };
    return fmt::format(fmt::runtime(tr("{} x {} x {} = {} blocks")), side(box.low.x, box.high.x),
                       side(box.low.y, box.high.y), side(box.low.z, box.high.z),
                       withCommas(box.blockCount()));
}

}  // namespace

void SelectionTool::drawPanel(OverlayLayout& layout, const BuildView& view) {
    if (!isActive_) return;
    pressed_.reset();
    ImGui::SetNextWindowBgAlpha(0.6f);
    if (layout.beginWindow(
            {.title = view.tr("Selection (B)"), .id = "selection", .flags = OverlayLayout::kPassive},
            {.alignX = 1, .minHeight = 80 * uiScale()})) {
        drawContents(view);
        ImGui::End();
    }
    if (pressed_) act(*pressed_, view);
    if (isAnswered_) answer(view);
}

void SelectionTool::drawContents(const BuildView& view) {
    const Texts& tr = view.tr;
    if (const auto box = selection_.box()) {
        ImGui::TextUnformatted(sizeText(tr, *box).c_str());
    } else {
        ImGui::TextUnformatted(tr("left, right button: corners"));
    }
    ImGui::Text(tr("with: %s"), tr.block(view.session.blocks().type(view.hand)).c_str());
    ImGui::Text(tr("shape: %s"), tr(nameOf(selection_.shapeKind())));
    if (const auto& clipboard = selection_.clipboard()) {
        const glm::ivec3 last = clipboard->size - 1;
        ImGui::Text(tr("copied: %s"), sizeText(tr, {{}, {last.x, last.y, last.z}}).c_str());
    }
    const ImVec2 size(130 * uiScale(), 0);
    int column = 0;
    for (const ToolRow& row : kToolActions) {
        if (column++ % 2 == 1) ImGui::SameLine();
        if (ui::button(tr(row.label), size)) pressed_ = row.action;
    }
    ImGui::TextUnformatted(tr("Shift: your own position"));
    ImGui::TextUnformatted(tr("Ctrl+wheel: height"));
    if (asks_ == Asks::Name) drawName(tr);
    if (asks_ == Asks::File) drawFiles(tr);
}

void SelectionTool::drawName(const Texts& tr) {
    ImGui::Separator();
    ImGui::TextUnformatted(tr("Name of the file, then Enter"));
    if (takesFocus_) ImGui::SetKeyboardFocusHere();
    takesFocus_ = false;
    ImGui::SetNextItemWidth(264 * uiScale());
    ui::textField("##name", "", name_.data(), name_.size());
}

void SelectionTool::drawFiles(const Texts& tr) {
    ImGui::Separator();
    ImGui::TextUnformatted(tr("Up, Down, Enter or a click"));
    ImGui::BeginChild("files", {264 * uiScale(), 120 * uiScale()});
    for (std::size_t k = 0; k < files_.size(); ++k) {
        ImGui::PushID(static_cast<int>(k));
        if (ui::selectable(files_[k].c_str(), k == file_)) {
            file_ = k;
            isAnswered_ = true;
        }
        if (k == file_) ImGui::SetScrollHereY();
        ImGui::PopID();
    }
    ImGui::EndChild();
}

void SelectionTool::drawOutlines(const Screen& screen, const render::Camera& camera,
                                 const BuildView& view) const {
    if (!isActive_) return;
    const ScreenProjection projection({screen.width, screen.height}, camera);
    if (const auto box = selection_.box()) {
        drawBox(projection, *box, 1 / 64.0, kSelected);
        if (selection_.shapeKind() == game::ShapeKind::Line) drawLineOf(projection, selection_.shape(), *box);
    }
    if (!selection_.isPasting()) return;
    const auto low = selection_.pasteCorner(pointedAt(view, true), view.session.world().heights());
    drawBox(projection, game::boxOf(game::PlaceStructure{selection_.clipboard(), *low}), 1 / 32.0, kPasted);
}

}  // namespace terrane::app
