// Places that change, such as where players are: looked up at most once a second, however many ask. On one
// thread.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "terrane/web/page.h"

namespace terrane::web {

class PlaceList {
  public:
    // An empty function finds none.
    explicit PlaceList(std::function<std::vector<NamedPlace>()> find) : find_(std::move(find)) {}

    const std::vector<NamedPlace>& places() {
        const auto now = std::chrono::steady_clock::now();
        if (!find_ || now < next_) return places_;
        next_ = now + std::chrono::seconds(1);
        places_ = find_();
        text_ = textOf(places_);
        return places_;
    }
    // JSON. It holds until the next call.
    const std::string& text() {
        (void)places();
        return text_;
    }

    std::string told;  // what browsers were told last

  private:
    std::function<std::vector<NamedPlace>()> find_;
    std::chrono::steady_clock::time_point next_{};
    std::vector<NamedPlace> places_;
    std::string text_ = "[]";
};

}  // namespace terrane::web
