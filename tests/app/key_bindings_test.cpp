#include "apps/terrane/window/settings/key_bindings.h"

#include <gmock/gmock.h>

#include <set>

namespace terrane::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(KeyBindings, TheTableIsInTheOrderOfTheActions) {
    std::set<std::string_view> names, labels;
    std::set<Key> keys;
    std::set<PadButton> buttons;
    std::size_t withKey = 0, withButton = 0;
    for (std::size_t k = 0; k < kActionCount; ++k) {
        const ActionRow& row = actionTable()[k];
        EXPECT_EQ(row.action, static_cast<Action>(k));
        EXPECT_EQ(&rowOf(row.action), &row);
        EXPECT_TRUE(row.key || row.pad) << row.name;
        EXPECT_TRUE(!row.key || canBeBound(*row.key));
        EXPECT_TRUE(!row.pad || canBeBound(*row.pad));
        names.insert(row.name);
        labels.insert(row.label);
        if (row.key) keys.insert(*row.key);
        if (row.pad) buttons.insert(*row.pad);
        withKey += row.key ? 1 : 0;
        withButton += row.pad ? 1 : 0;
    }
    EXPECT_EQ(names.size(), kActionCount);
    EXPECT_EQ(labels.size(), kActionCount);
    EXPECT_EQ(keys.size(), withKey) << "two actions have the same usual key";
    EXPECT_EQ(buttons.size(), withButton) << "two actions have the same usual button";
}

TEST(KeyBindings, EveryKeyHasOneName) {
    std::set<std::string_view> names;
    for (int k = 0; k < static_cast<int>(kKeyCount); ++k) {
        const Key key = static_cast<Key>(k);
        EXPECT_EQ(keyNamed(nameOf(key)), key);
        names.insert(nameOf(key));
    }
    EXPECT_EQ(names.size(), kKeyCount);
    EXPECT_EQ(keyNamed("space"), Key::Space);
    EXPECT_EQ(keyNamed("f12"), Key::F12);
    EXPECT_EQ(keyNamed("Digit9"), std::nullopt);
    EXPECT_EQ(keyNamed(""), std::nullopt);
}

TEST(KeyBindings, KeysLeadToActionsAndBack) {
    const KeyBindings keys;
    EXPECT_TRUE(keys.isUsual());
    EXPECT_EQ(keys.actionOf(Key::Space), Action::Jump);
    EXPECT_EQ(keys.keyOf(Action::Jump), Key::Space);
    EXPECT_EQ(keys.actionOf(Key::Up), Action::Forward);
    EXPECT_THAT(keys.keysOf(Action::Forward), ElementsAre(Key::W, Key::Up));
    EXPECT_EQ(keys.actionOf(Key::Escape), std::nullopt);
}

TEST(KeyBindings, AKeyBelongsToOneAction) {
    KeyBindings keys;
    EXPECT_EQ(keys.bind(Action::Jump, Key::X), std::nullopt);
    EXPECT_EQ(keys.actionOf(Key::Space), std::nullopt);
    EXPECT_EQ(keys.bind(Action::Run, Key::X), Action::Jump);
    EXPECT_EQ(keys.actionOf(Key::X), Action::Run);
    EXPECT_EQ(keys.keyOf(Action::Jump), std::nullopt);
    EXPECT_THAT(keys.keysOf(Action::Jump), IsEmpty());
    // The second key of another action becomes the first of this one.
    EXPECT_EQ(keys.bind(Action::Jump, Key::Up), std::nullopt);
    EXPECT_EQ(keys.actionOf(Key::Up), Action::Jump);
    EXPECT_THAT(keys.keysOf(Action::Forward), ElementsAre(Key::W));
    EXPECT_FALSE(keys.isUsual());
    keys = KeyBindings();
    EXPECT_EQ(keys.bind(Action::Jump, Key::Escape), std::nullopt);
    EXPECT_EQ(keys.bind(Action::Jump, Key::B), std::nullopt) << "the selection tool takes it first";
    EXPECT_TRUE(keys.isUsual());
}

TEST(KeyBindings, OnlyWhatDiffersIsWritten) {
    KeyBindings keys;
    EXPECT_EQ(textOf(keys), "");
    keys.bind(Action::Forward, Key::S);  // back loses its key
    keys.bind(Action::Screenshot, Key::P);
    EXPECT_EQ(textOf(keys), "forward=S,back=none,later=none,screenshot=P");
    EXPECT_EQ(*keyBindingsFrom(textOf(keys)), keys);
    keys.bind(Action::Back, Key::W);
    EXPECT_EQ(*keyBindingsFrom(textOf(keys)), keys);
    EXPECT_TRUE(keyBindingsFrom("")->isUsual());
}

TEST(KeyBindings, WrongTextsAreNamed) {
    const auto problem = [](const char* text) {
        const auto read = keyBindingsFrom(text);
        return read ? "none" : read.error().message;
    };
    EXPECT_EQ(problem("jump"), "expected ACTION=KEY, got \"jump\"");
    EXPECT_THAT(problem("jmup=A"), HasSubstr("did you mean jump?"));
    EXPECT_EQ(problem("jump=Hyper"), "jump: \"Hyper\" is no key that can be chosen");
    EXPECT_EQ(problem("jump=Escape"), "jump: \"Escape\" is no key that can be chosen");
    EXPECT_EQ(problem("run=R,,jump=F"), "expected ACTION=KEY, got \"\"");
}

TEST(KeyBindings, MouseButtonsBeyondThreeAreKeys) {
    EXPECT_EQ(keyNamed("mouse4"), Key::Mouse4);
    const auto keys = keyBindingsFrom("break=Mouse4,chat=Mouse5");
    ASSERT_TRUE(keys);
    EXPECT_EQ(keys->actionOf(Key::Mouse4), Action::Break);
    EXPECT_EQ(textOf(*keys), "chat=Mouse5,break=Mouse4");
}

TEST(PadBindings, EveryButtonHasOneNameAndOneMember) {
    std::set<std::string_view> names, labels;
    for (std::size_t k = 0; k < static_cast<std::size_t>(PadButton::kCount); ++k) {
        const PadButton button = static_cast<PadButton>(k);
        EXPECT_EQ(rowOf(button).button, button);
        EXPECT_EQ(padButtonNamed(nameOf(button)), button);
        names.insert(nameOf(button));
        labels.insert(rowOf(button).label);
        Gamepad pad;
        pad.*rowOf(button).member = true;
        PadReader reader;
        reader.read(pad);
        EXPECT_EQ(reader.pressed(), button);
    }
    EXPECT_EQ(names.size(), static_cast<std::size_t>(PadButton::kCount));
    EXPECT_EQ(labels.size(), names.size());
    EXPECT_EQ(padButtonNamed("leftstick"), PadButton::LeftStick);
}

TEST(PadBindings, AreBoundAsKeysAre) {
    PadBindings pad;
    EXPECT_EQ(pad.actionOf(PadButton::South), Action::Jump);
    EXPECT_EQ(pad.bind(Action::Break, PadButton::South), Action::Jump);
    EXPECT_EQ(pad.keyOf(Action::Jump), std::nullopt);
    EXPECT_EQ(pad.bind(Action::Jump, PadButton::Start), std::nullopt) << "it opens the menu";
    EXPECT_EQ(pad.keyOf(Action::Jump), std::nullopt);
    EXPECT_EQ(textOf(pad), "jump=none,break=South");
    EXPECT_EQ(*padBindingsFrom(textOf(pad)), pad);
    EXPECT_EQ(textOf(PadBindings()), "");
}

TEST(PadBindings, WrongTextsAreNamed) {
    const auto problem = [](const char* text) {
        const auto read = padBindingsFrom(text);
        return read ? "none" : read.error().message;
    };
    EXPECT_EQ(problem("jump"), "expected ACTION=BUTTON, got \"jump\"");
    EXPECT_EQ(problem("jump=Space"), "jump: \"Space\" is no button that can be chosen");
    EXPECT_EQ(problem("jump=Start"), "jump: \"Start\" is no button that can be chosen");
    EXPECT_THAT(problem("jmup=South"), HasSubstr("did you mean jump?"));
}

}  // namespace
}  // namespace terrane::app
