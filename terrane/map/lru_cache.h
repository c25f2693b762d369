// A cache of the most recently used items, limited by a number of bytes. It is not synchronized.
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <unordered_map>
#include <utility>

namespace terrane::map {

template <class Key, class Value, class Hash = std::hash<Key>>
class LruCache {
  public:
    explicit LruCache(std::size_t maxBytes) : maxBytes_(maxBytes) {}

    // Returns the value, or null if the cache does not have it. This counts as a use. The pointer is valid
    // until the next call of put() or erase().
    const Value* find(const Key& key) {
        const auto found = places_.find(key);
        if (found == places_.end()) return nullptr;
        items_.splice(items_.begin(), items_, found->second);
        return &items_.front().value;
    }

    // Returns whether the cache has the key, without counting as a use.
    bool contains(const Key& key) const { return places_.contains(key); }

    // Replaces the value of the key. Removes the least recently used items.
    void put(const Key& key, Value value, std::size_t bytes) {
        erase(key);
        items_.push_front({key, std::move(value), bytes});
        places_[key] = items_.begin();
        bytes_ += bytes;
        while (bytes_ > maxBytes_ && !items_.empty()) erase(Key(items_.back().key));
    }

    void erase(const Key& key) {
        const auto found = places_.find(key);
        if (found == places_.end()) return;
        bytes_ -= found->second->bytes;
        items_.erase(found->second);
        places_.erase(found);
    }

    std::size_t bytes() const { return bytes_; }
    std::size_t count() const { return items_.size(); }

  private:
    struct Item {
        Key key;
        Value value;
        std::size_t bytes;
    };
    std::size_t maxBytes_, bytes_ = 0;
    std::list<Item> items_;  // most recently used first
    std::unordered_map<Key, typename std::list<Item>::iterator, Hash> places_;
};

}  // namespace terrane::map
