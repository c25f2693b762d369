// Server-sent events, broadcast to all listeners. A listener that reads too slowly is removed. It is used on
// the web's thread.
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
    // Receives each event as text; returns false if the listener has disconnected.
    using Listener = std::function<bool(const EventText&)>;
    // Adds a listener and sends it the last remembered event of each name.
    void add(Listener listener);
    // Sends an event. `data`: one line. A remembered event is also sent to later listeners.
    void publish(std::string_view name, std::string_view data, bool isRemembered);
    void removeRemembered(std::string_view name);
    // Sends a comment, which detects lost connections and prevents proxies from closing idle ones.
    void sendKeepAlive();
    std::size_t count() const { return listeners_.size(); }

  private:
    void send(const EventText& text);

    std::map<std::uint64_t, Listener> listeners_;
    std::uint64_t lastId_ = 0;
    std::map<std::string, EventText, std::less<>> remembered_;
};

}  // namespace terrane::web
