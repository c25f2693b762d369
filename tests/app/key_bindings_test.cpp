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
    for (std::size_t k = 0; k < kActionCount; ++k) {
        const ActionRow& row = actionTable()[k];
        EXPECT_EQ(row.action, static_cast<Action>(k));
        EXPECT_EQ(&rowOf(row.action), &row);
        EXPECT_TRUE(canBeBound(row.key));
        names.insert(row.name);
        labels.insert(row.label);
        keys.insert(row.key);
    }
    EXPECT_EQ(names.size(), kActionCount);
    EXPECT_EQ(labels.size(), kActionCount);
    EXPECT_EQ(keys.size(), kActionCount) << "two actions have the same usual key";
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

}  // namespace
}  // namespace terrane::app
