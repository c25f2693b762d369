#include "terrane/web/event_hub.h"

#include <fmt/format.h>

#include <utility>

namespace terrane::web {

void EventHub::add(Listener listener) {
    for (const auto& [name, text] : remembered_)
        if (!listener(text)) return;
    listeners_.emplace(++lastId_, std::move(listener));
}

void EventHub::publish(std::string_view name, std::string_view data, bool isRemembered) {
    const auto text = std::make_shared<const std::string>(fmt::format("event: {}\ndata: {}\n\n", name, data));
    if (isRemembered) remembered_[std::string(name)] = text;
    send(text);
}

void EventHub::removeRemembered(std::string_view name) {
    if (const auto found = remembered_.find(name); found != remembered_.end()) remembered_.erase(found);
}

void EventHub::sendKeepAlive() {
    send(std::make_shared<const std::string>(":\n\n"));
}

void EventHub::send(const EventText& text) {
    std::erase_if(listeners_, [&](const auto& entry) { return !entry.second(text); });
}

}  // namespace terrane::web
