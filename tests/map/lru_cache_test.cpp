#include "terrane/map/lru_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace terrane::map {
namespace {

TEST(LruCache, ForgetWhatWasNotUsedForLongest) {
    LruCache<int, std::string> items(30);
    items.put(1, "one", 10);
    items.put(2, "two", 10);
    items.put(3, "three", 10);
    ASSERT_TRUE(items.find(1));
    EXPECT_EQ(*items.find(1), "one");
    items.put(4, "four", 10);
    EXPECT_FALSE(items.find(2)) << "the only one that was not asked for since";
    EXPECT_TRUE(items.find(1));
    EXPECT_TRUE(items.find(3));
    EXPECT_EQ(items.bytes(), 30u);
    items.put(5, "five", 20);
    EXPECT_FALSE(items.find(4));
    EXPECT_FALSE(items.find(1));
    EXPECT_TRUE(items.find(3));
    EXPECT_EQ(items.count(), 2u);
}

TEST(LruCache, PutReplaces) {
    LruCache<int, std::string> items(30);
    items.put(1, "one", 10);
    items.put(1, "uno", 25);
    EXPECT_EQ(*items.find(1), "uno");
    EXPECT_EQ(items.bytes(), 25u);
    EXPECT_EQ(items.count(), 1u);
    items.erase(1);
    items.erase(1);
    EXPECT_FALSE(items.find(1));
    EXPECT_EQ(items.bytes(), 0u);
}

TEST(LruCache, WhatIsTooLargeIsNotKept) {
    LruCache<int, std::string> items(30);
    items.put(1, "one", 10);
    items.put(2, "much", 31);
    EXPECT_FALSE(items.find(2));
    EXPECT_EQ(items.bytes(), 0u);
    items.put(3, "all", 30);
    EXPECT_TRUE(items.find(3));
}

// Compared with a list that is searched from its end.
TEST(LruCache, AreThoseOfASlowList) {
    struct Item {
        int key, value;
        std::size_t bytes;
    };
    constexpr std::size_t kMost = 100;
    LruCache<int, int> items(kMost);
    std::vector<Item> list;  // used last at the end
    std::mt19937 random(1);
    for (int step = 0; step < 20000; ++step) {
        const int key = static_cast<int>(random() % 30);
        const auto found = std::ranges::find(list, key, &Item::key);
        if (random() % 2 == 0) {
            const int* value = items.find(key);
            ASSERT_EQ(value != nullptr, found != list.end());
            if (!value) continue;
            ASSERT_EQ(*value, found->value);
            std::rotate(found, found + 1, list.end());
        } else if (random() % 8 == 0) {
            items.erase(key);
            if (found != list.end()) list.erase(found);
        } else {
            const std::size_t bytes = random() % 40;
            if (found != list.end()) list.erase(found);
            list.push_back({key, step, bytes});
            items.put(key, step, bytes);
        }
        const auto sum = [&] {
            std::size_t bytes = 0;
            for (const Item& item : list) bytes += item.bytes;
            return bytes;
        };
        while (sum() > kMost) list.erase(list.begin());
        ASSERT_EQ(items.bytes(), sum());
        ASSERT_EQ(items.count(), list.size());
    }
}

TEST(LruCache, ContainsIsNoUse) {
    LruCache<int, int> items(20);
    items.put(1, 1, 10);
    items.put(2, 2, 10);
    EXPECT_TRUE(items.contains(1));
    EXPECT_FALSE(items.contains(3));
    items.put(3, 3, 10);
    EXPECT_FALSE(items.contains(1));
    EXPECT_TRUE(items.contains(2));
}

}  // namespace
}  // namespace terrane::map
