#include "apps/terrane/window/edit_texts.h"

#include <fmt/format.h>

namespace terrane::app {

std::string refusalText(game::EditResult result, const Texts& tr) {
    if (result == game::EditResult::NotEmpty) return tr("it is not empty: take everything out first");
    if (result == game::EditResult::Protected) return tr("the lowest layer of the world cannot be broken");
    if (result == game::EditResult::Claimed) return tr("this place belongs to somebody else");
    if (result == game::EditResult::NotAllowed) return tr("guests cannot change anything");
    return {};
}

std::string takenBackText(const game::TakenBack& done, game::HistoryWay way, const Texts& tr) {
    using Outcome = game::TakenBack::Outcome;
    const bool isUndo = way == game::HistoryWay::Undo;
    if (done.outcome == Outcome::Sent) return {};
    if (done.outcome == Outcome::NoStep) return isUndo ? tr("nothing to undo") : tr("nothing to redo");
    if (done.outcome == Outcome::NotLoaded) return tr("too far away: the place of that edit is not loaded");
    if (done.outcome == Outcome::NotAllowed) return tr("you may not change a part of it");
    const char* what = isUndo ? tr("undone: {} blocks") : tr("redone: {} blocks");
    std::string text = fmt::format(fmt::runtime(what), done.blocks);
    if (done.kept > 0) text += fmt::format(fmt::runtime(tr(", {} changed since then and stay")), done.kept);
    return text;
}

}  // namespace terrane::app
