#include "terrane/game/item_keeper.h"

#include <utility>

#include "terrane/base/log.h"

namespace terrane::game {
namespace {

constexpr std::string_view kItems = "items";

}  // namespace

ItemKeeper::ItemKeeper(Session& session) : session_(session) {
    store::ChunkStore& store = session.store();
    session.mode = loadMode(store);
    if (const auto text = store.metadata(kItems)) {
        auto items = parsePlayerItems(*text);
        if (items)
            session.setItems(kLocalPlayer, std::move(*items));
        else
            base::logError("the save's items: {}", items.error().message);
    }
    changed_ = session.events.items.add([this](const ItemsChanged& event) {
        if (event.player != kLocalPlayer) return;
        isChanged_ = true;
        session_.queueSaves();
    });
    saving_ = session.events.saving.add([this](const Saving&) { queue(); });
}

void ItemKeeper::queue() {
    if (std::exchange(isChanged_, false))
        session_.store().setMetadata(kItems, textOf(session_.itemsOf(kLocalPlayer)));
}

}  // namespace terrane::game
