#include "terrane/web/event_hub.h"

#include <gmock/gmock.h>

#include <vector>

namespace terrane::web {
namespace {

using testing::ElementsAre;

struct Heard {
    EventHub::Listener listener() {
        return [this](const EventText& text) {
            texts.push_back(*text);
            return isThere;
        };
    }
    std::vector<std::string> texts;
    bool isThere = true;
};

TEST(EventHub, TellsAllListeners) {
    EventHub hub;
    Heard one, two;
    hub.publish("edits", "[0]", false);
    hub.add(one.listener());
    hub.add(two.listener());
    hub.publish("edits", "[1]", false);
    hub.sendKeepAlive();
    EXPECT_THAT(one.texts, ElementsAre("event: edits\ndata: [1]\n\n", ":\n\n"));
    EXPECT_EQ(two.texts, one.texts);
    EXPECT_EQ(hub.count(), 2u);
}

TEST(EventHub, NewcomersAreToldWhatIsRemembered) {
    EventHub hub;
    hub.publish("players", "[1]", true);
    hub.publish("edits", "[2]", false);
    hub.publish("players", "[3]", true);
    hub.publish("places", "[4]", true);
    Heard late;
    hub.add(late.listener());
    EXPECT_THAT(late.texts, ElementsAre("event: places\ndata: [4]\n\n", "event: players\ndata: [3]\n\n"));
    hub.removeRemembered("players");
    hub.removeRemembered("nothing");
    Heard later;
    hub.add(later.listener());
    EXPECT_THAT(later.texts, ElementsAre("event: places\ndata: [4]\n\n"));
}

TEST(EventHub, WhoIsGoneIsDropped) {
    EventHub hub;
    Heard one, two;
    hub.add(one.listener());
    hub.add(two.listener());
    one.isThere = false;
    hub.publish("edits", "[1]", false);
    hub.publish("edits", "[2]", false);
    EXPECT_EQ(one.texts.size(), 1u);
    EXPECT_EQ(two.texts.size(), 2u);
    EXPECT_EQ(hub.count(), 1u);
    // Also at once, if a remembered event cannot be sent.
    hub.publish("players", "[3]", true);
    Heard gone;
    gone.isThere = false;
    hub.add(gone.listener());
    EXPECT_EQ(hub.count(), 1u);
    EXPECT_EQ(gone.texts.size(), 1u);
    hub.sendKeepAlive();
    EXPECT_EQ(gone.texts.size(), 1u);
}

}  // namespace
}  // namespace terrane::web
