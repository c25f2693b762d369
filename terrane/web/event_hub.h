// Server-sent events: lines that go to all who listen. What a listener cannot take in time is dropped with
// it. On the web's thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace terrane::web {

using EventText = std::shared_ptr<const std::string>;

class EventHub {
  public:
    // Gets each event as text; returns false where the listener is gone.
    using Listener = std::function<bool(const EventText&)>;
    // It gets the newest event of each name that is remembered, at once.
    void add(Listener listener);
    // `data`: one line. A remembered event is also told to who comes later.
    void tell(std::string_view name, std::string_view data, bool isRemembered);
    void forget(std::string_view name);
    // A comment, so that a connection that is gone is noticed and proxies keep others open.
    void sendKeepAlive();
    std::size_t count() const { return listeners_.size(); }

  private:
    void send(const EventText& text);

    std::map<std::uint64_t, Listener> listeners_;
    std::uint64_t lastId_ = 0;
    std::map<std::string, EventText, std::less<>> remembered_;
};

}  // namespace terrane::web
