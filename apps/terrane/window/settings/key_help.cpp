#include "apps/terrane/window/settings/key_help.h"

#include <fmt/format.h>

#include <algorithm>

namespace terrane::app {
namespace {

struct Row {
    const char* fixed;  // keys and buttons that cannot be changed; otherwise null
    std::vector<Action> actions;
    const char* effect;
};

const std::vector<Row>& rows() {
    using enum Action;
    static const std::vector<Row> kRows = {
        {trLater("click"), {}, trLater("look around with the mouse; Esc releases the cursor")},
        {nullptr, {Forward, Left, Back, Right}, trLater("walk")},
        {nullptr, {Jump, Run}, trLater("jump, twice quickly: fly or land; run, fly faster")},
        {nullptr, {Up, Down}, trLater("fly or swim up; down")},
        {nullptr, {Movement}, trLater("next movement mode: walk, fly, fly through blocks")},
        {trLater("left, right button"),
         {},
         trLater("break a block; place one, open a door or a chest (Shift: place against it)")},
        {trLater("1 to 9, wheel"),
         {},
         trLater("choose a hotbar slot; middle button: pick the block under the crosshair")},
        {nullptr, {Palette}, trLater("all blocks, with search")},
        {trLater("Ctrl+Z, Ctrl+Y"), {}, trLater("undo; redo")},
        {"B", {}, trLater("select a box: fill, replace, shapes, copy, paste, rotate, mirror, save")},
        {nullptr, {Places, Spawn}, trLater("named places; go to the spawn")},
        {nullptr, {Chat, PlayerList}, trLater("chat and commands; on a server the list of players")},
        {nullptr, {Earlier, Later, HoldTime}, trLater("time of day back; forward; stop or run time")},
        {nullptr, {Help, Panel}, trLater("these keys; developer panel")},
        {nullptr, {TopView, LoadingMap}, trLater("debug top view; map of loaded chunks")},
        {nullptr, {SaveBookmark, NextBookmark}, trLater("save a bookmark; go to the next one")},
        {nullptr, {Facts, HideHud}, trLater("position, biome and targeted block; hide the interface")},
        {nullptr,
         {FullScreen, Screenshot, Light},
         trLater("full screen; screenshot; classic or smooth light")},
        {"Esc", {}, trLater("close what is open, else the menu: settings, save and quit")},
    };
    return kRows;
}

}  // namespace

std::string keyText(std::optional<Key> key, const Texts& tr) {
    return key ? std::string(content::text(tr.language, nameOf(*key))) : tr("none");
}

std::string padButtonText(std::optional<PadButton> button, const Texts& tr) {
    return button ? tr(rowOf(*button).label) : tr("none");
}

std::vector<std::string> hintLines(const KeyBindings& bindings, const Texts& tr) {
    const auto key = [&](Action action) { return keyText(bindings.keyOf(action), tr); };
    using enum Action;
    return {fmt::format(fmt::runtime(tr("{} {} {} {}: walk; {}: jump, twice: fly")), key(Forward), key(Left),
                        key(Back), key(Right), key(Jump)),
            tr("click: look around; then left button: break, right: place"),
            fmt::format(fmt::runtime(tr("{}: all keys; Esc: menu")), key(Help))};
}

std::vector<KeyHelpLine> keyHelpLines(const KeyBindings& bindings, const Texts& tr) {
    std::vector<KeyHelpLine> lines;
    for (const Row& row : rows()) {
        std::string keys = row.fixed != nullptr ? tr(row.fixed) : "";
        for (const Action action : row.actions)
            keys += (keys.empty() ? "" : ", ") + keyText(bindings.keyOf(action), tr);
        lines.push_back({std::move(keys), tr(row.effect)});
    }
    return lines;
}

std::string keyHelpText() {
    const std::vector<KeyHelpLine> lines = keyHelpLines({}, {});
    std::size_t width = 0;
    for (const KeyHelpLine& line : lines) width = std::max(width, line.keys.size());
    std::string text;
    for (const KeyHelpLine& line : lines)
        text += fmt::format("  {:<{}}  {}\n", line.keys, width, line.effect);
    return text;
}

}  // namespace terrane::app
