#include "terrane/base/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace terrane::base {

ProgressBar::ProgressBar(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), isTerminal_(isatty(STDERR_FILENO) == 1) {
    set(0);
}

ProgressBar::~ProgressBar() {
    if (isTerminal_) fmt::print(stderr, "\n");
}

void ProgressBar::set(std::size_t done) {
    const int percent = total_ == 0 ? 100 : static_cast<int>(100 * done / total_);
    if (!isTerminal_ || percent == shownPercent_) return;
    shownPercent_ = percent;
    constexpr int kWidth = 40;
    const int filled = percent * kWidth / 100;
    fmt::print(stderr, "\r{} [{:=<{}}{:{}}] {:3}%", what_, "", filled, "", kWidth - filled, percent);
    std::fflush(stderr);
}

}  // namespace terrane::base
