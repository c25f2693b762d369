#include "terrane/web/metrics.h"

#include <fmt/format.h>

#include <algorithm>

namespace terrane::web {

void Histogram::add(double value) {
    ++count;
    sum += value;
    const auto bucket = std::ranges::lower_bound(bounds, value) - bounds.begin();
    if (static_cast<std::size_t>(bucket) < counts.size()) ++counts[static_cast<std::size_t>(bucket)];
}

void MetricsText::histogram(std::string_view name, std::string_view help, const Histogram& histogram) {
    begin(name, help, "histogram");
    std::uint64_t upTo = 0;
    for (std::size_t k = 0; k < histogram.bounds.size(); ++k) {
        upTo += histogram.counts[k];
        text_ += fmt::format("{}_bucket{{le=\"{}\"}} {}\n", name, histogram.bounds[k], upTo);
    }
    text_ += fmt::format("{0}_bucket{{le=\"+Inf\"}} {1}\n{0}_sum {2}\n{0}_count {1}\n", name, histogram.count,
                         histogram.sum);
}

void MetricsText::begin(std::string_view name, std::string_view help, std::string_view type) {
    text_ += fmt::format("# HELP {} {}\n# TYPE {} {}\n", name, help, name, type);
}

void MetricsText::add(std::string_view name, std::string_view help, std::string_view type, double value) {
    begin(name, help, type);
    text_ += fmt::format("{} {}\n", name, value);
}

void MetricsText::sample(std::string_view name, std::string_view labels, double value) {
    text_ += fmt::format("{}{{{}}} {}\n", name, labels, value);
}

}  // namespace terrane::web
