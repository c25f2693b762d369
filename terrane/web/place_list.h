// A list of places that change, such as players' positions: looked up at most once per second. On one thread.
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
    // Without a function the list is empty.
    explicit PlaceList(std::function<std::vector<NamedPlace>()> find) : find_(std::move(find)) {}

    const std::vector<NamedPlace>& places() {
        const auto now = std::chrono::steady_clock::now();
        if (!find_ || now < next_) return places_;
        next_ = now + std::chrono::seconds(1);
        places_ = find_();
        text_ = textOf(places_);
        return places_;
    }
    // JSON, valid until the next call.
    const std::string& text() {
        (void)places();
        return text_;
    }

    std::string told;  // last text sent to browsers

  private:
    std::function<std::vector<NamedPlace>()> find_;
    std::chrono::steady_clock::time_point next_{};
    std::vector<NamedPlace> places_;
    std::string text_ = "[]";
};

}  // namespace terrane::web
