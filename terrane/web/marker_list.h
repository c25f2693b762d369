// A list of markers that change, such as players' positions, refreshed at most once per second. It is used on
// one thread.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "terrane/web/page.h"

namespace terrane::web {

class MarkerList {
  public:
    // Without a function the list is empty.
    explicit MarkerList(std::function<std::vector<MapMarker>()> find) : find_(std::move(find)) {}

    const std::vector<MapMarker>& places() {
        const auto now = std::chrono::steady_clock::now();
        if (!find_ || now < next_) return places_;
        next_ = now + std::chrono::seconds(1);
        places_ = find_();
        text_ = textOf(places_);
        return places_;
    }
    // Returns the list as JSON; the reference is valid until the next call.
    const std::string& text() {
        (void)places();
        return text_;
    }

    std::string sent;  // last text sent to browsers

  private:
    std::function<std::vector<MapMarker>()> find_;
    std::chrono::steady_clock::time_point next_{};
    std::vector<MapMarker> places_;
    std::string text_ = "[]";
};

}  // namespace terrane::web
