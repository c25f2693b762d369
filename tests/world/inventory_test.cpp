#include "terrane/world/blocks/inventory.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace terrane::world {
namespace {

TEST(Inventory, FillsStacksOfTheSameItemFirst) {
    Inventory chest(3);
    EXPECT_EQ(addItems(chest, "stone", 5), 0);
    EXPECT_EQ(addItems(chest, "sand", 98), 0);
    EXPECT_EQ(addItems(chest, "stone", 10), 0);
    EXPECT_EQ(chest, (Inventory{{"stone", 15}, {"sand", 98}, {}}));
    EXPECT_EQ(addItems(chest, "sand", 60), 0);
    EXPECT_EQ(chest, (Inventory{{"stone", 15}, {"sand", 99}, {"sand", 59}}));
    EXPECT_EQ(addItems(chest, "glass", 7), 7) << "it is full";
    EXPECT_EQ(addItems(chest, "sand", 50), 10);
    EXPECT_EQ(chest, (Inventory{{"stone", 15}, {"sand", 99}, {"sand", 99}}));
}

TEST(Inventory, TakesFromTheLastStackOn) {
    Inventory chest = {{"sand", 99}, {"stone", 1}, {"sand", 4}};
    EXPECT_EQ(takeItems(chest, "sand", 5), 5);
    EXPECT_EQ(chest, (Inventory{{"sand", 98}, {"stone", 1}, {}}));
    EXPECT_EQ(takeItems(chest, "sand", 1000), 98);
    EXPECT_EQ(takeItems(chest, "sand", 1), 0);
    EXPECT_EQ(chest, (Inventory{{}, {"stone", 1}, {}}));
}

TEST(Inventory, WornToolsKeepTheirBytes) {
    const Inventory chest = {{"pick", 1, 700}, {}, {"stone", 99}};
    const BlockEntityData bytes = encodeInventory(chest);
    EXPECT_EQ(bytes[0], std::byte{2});
    EXPECT_EQ(decodeInventory(bytes, 3).value(), chest);
    for (std::size_t length = 0; length < bytes.size(); ++length)
        EXPECT_FALSE(decodeSlots({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)}));
    EXPECT_EQ(encodeInventory({{"pick", 1}})[0], std::byte{1}) << "programs without wear read it";
}

TEST(Inventory, MovesMergeSwapOrStay) {
    ItemStack a{"stone", 60}, b{"stone", 50}, pick{"pick", 1, 3}, empty;
    EXPECT_TRUE(moveItems(a, b, 100));
    EXPECT_EQ(a.count, 11) << "49 found room";
    EXPECT_EQ(b.count, 99);
    EXPECT_FALSE(moveItems(a, b, 100)) << "full";
    EXPECT_FALSE(moveItems(a, pick, 10)) << "a part of a stack does not change places";
    EXPECT_TRUE(moveItems(a, pick, 11));
    EXPECT_EQ(a, (ItemStack{"pick", 1, 3}));
    EXPECT_EQ(pick, (ItemStack{"stone", 11}));
    EXPECT_TRUE(moveItems(pick, empty, 10));
    EXPECT_EQ(empty, (ItemStack{"stone", 10}));
    ItemStack other{"pick", 1, 4};
    EXPECT_TRUE(moveItems(a, other, 1)) << "other wear is another kind: they change places";
    EXPECT_EQ(a.wear, 4);
    EXPECT_FALSE(moveItems(a, a, 1));
    EXPECT_EQ(addToStack(a, "pick", 1), 1) << "new items do not join worn ones";
}

TEST(Inventory, BytesComeBack) {
    const Inventory chest = {{"stone", 99}, {}, {std::string(kMaxItemName, 'x'), 1}};
    EXPECT_EQ(decodeInventory(encodeInventory(chest), 3).value(), chest);
    EXPECT_EQ(decodeInventory(encodeInventory({}), 27).value(), Inventory(27)) << "slots that are new";
}

// Programs up to 0.2 accepted more slots than the block has.
TEST(Inventory, StacksBeyondTheSlotsAreShownAndNotLost) {
    Inventory hidden(301);
    hidden[300] = {"stone", 1};
    hidden[290] = {"sand", 7};
    EXPECT_EQ(decodeInventory(encodeInventory(hidden), 3).value(),
              (Inventory{{"sand", 7}, {"stone", 1}, {}}));
    const Inventory full = {{"stone", 99}, {"sand", 1}, {}, {"glass", 2}, {}, {"dirt", 3}};
    EXPECT_EQ(decodeInventory(encodeInventory(full), 3).value(),
              (Inventory{{"stone", 99}, {"sand", 1}, {"glass", 2}, {"dirt", 3}}));
}

TEST(Inventory, IsAcceptedWithTheSlotsOfItsBlock) {
    const Inventory empty(3), good = {{"stone", 99}, {}, {"sand", 1}};
    EXPECT_TRUE(mayReplace(empty, good, 3));
    EXPECT_TRUE(mayReplace(good, empty, 3));
    for (const std::size_t slots : {0, 2, 4, 10000})
        EXPECT_FALSE(mayReplace(empty, Inventory(slots), 3)) << slots;
    EXPECT_FALSE(mayReplace(empty, {{"stone", 100}, {}, {}}, 3)) << "more than a stack";
    for (const char* name : {"\x1b[31m", "a\nb", "\xff", "\u202e"})
        EXPECT_FALSE(mayReplace(empty, {{name, 1}, {}, {}}, 3)) << name;
}

// An old chest that holds too much can be emptied, and gets no more.
TEST(Inventory, WhatHoldsTooMuchCanBeEmptied) {
    const Inventory former = {{"stone", 99}, {"sand", 1}, {"glass", 200}, {"a\nb", 2}};
    Inventory less = former;
    less[2].count = 199;
    EXPECT_TRUE(mayReplace(former, less, 3));
    less[3] = {};
    EXPECT_TRUE(mayReplace(former, less, 3));
    EXPECT_FALSE(mayReplace(less, former, 3)) << "what was taken does not come back";
    Inventory more = former;
    more.push_back({"dirt", 1});
    EXPECT_FALSE(mayReplace(former, more, 3));
    more = former;
    more[2].count = 201;
    EXPECT_FALSE(mayReplace(former, more, 3));
}

TEST(Inventory, AStackTakesItsOwnItemUpToItsEnd) {
    ItemStack stack;
    EXPECT_EQ(addToStack(stack, "stone", 60), 0);
    EXPECT_EQ(addToStack(stack, "sand", 1), 1) << "another item";
    EXPECT_EQ(addToStack(stack, "stone", 60), 60 + 60 - kMaxStack);
    EXPECT_EQ(stack, (ItemStack{"stone", kMaxStack}));
    EXPECT_EQ(takeFromStack(stack, 1), 1);
    EXPECT_EQ(takeFromStack(stack, 200), kMaxStack - 1);
    EXPECT_EQ(stack, ItemStack{}) << "an empty stack has no name";
    EXPECT_EQ(takeFromStack(stack, 1), 0);
}

TEST(Inventory, EveryCutIsFound) {
    const BlockEntityData whole = encodeInventory({{"stone", 99}, {}, {"sand", 1}});
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const BlockEntityData cut(whole.begin(), whole.begin() + static_cast<long>(length));
        EXPECT_FALSE(decodeInventory(cut, 3)) << length;
    }
    BlockEntityData longer = whole;
    longer.push_back({});
    EXPECT_FALSE(decodeInventory(longer, 3));
    BlockEntityData newer = whole;
    newer[0] = std::byte{2};
    EXPECT_FALSE(decodeInventory(newer, 3));
}

TEST(Inventory, AnyBytesGiveAnInventoryOrAnError) {
    std::mt19937 random(7);
    for (int round = 0; round < 5000; ++round) {
        BlockEntityData bytes = encodeInventory({{"stone", 9}, {}, {"a", 1}});
        for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        const auto decoded = decodeInventory(bytes, 3);
        if (!decoded) continue;
        EXPECT_GE(decoded->size(), 3u);
        EXPECT_EQ(decodeInventory(encodeInventory(*decoded), 3).value(), *decoded);
    }
}

// Bytes that decodeInventory() rejects are never made: names have an 8-bit length, slots a 16-bit number.
TEST(Inventory, RefusesCountsAndNamesThatDoNotFit) {
    Inventory chest(2);
    ItemStack stack;
    EXPECT_THROW(addItems(chest, "", 1), std::invalid_argument);
    EXPECT_THROW(addItems(chest, std::string(256, 'a'), 1), std::invalid_argument);
    EXPECT_THROW(addItems(chest, "stone", -1), std::invalid_argument);
    EXPECT_THROW(takeItems(chest, "stone", -1), std::invalid_argument);
    EXPECT_THROW(addToStack(stack, "stone", -1), std::invalid_argument);
    EXPECT_THROW(takeFromStack(stack, -1), std::invalid_argument);
    EXPECT_THROW(encodeInventory({{std::string(256, 'a'), 1}}), std::invalid_argument);
    EXPECT_THROW(encodeInventory(Inventory(65536)), std::invalid_argument);
    EXPECT_EQ(chest, Inventory(2));
    EXPECT_EQ(addItems(chest, std::string(255, 'a'), 1), 0);
    EXPECT_EQ(decodeInventory(encodeInventory(chest), 2).value(), chest);
}

}  // namespace
}  // namespace terrane::world
