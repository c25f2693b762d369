// Figures in the text format of Prometheus (prometheus.io, "Exposition formats", version 0.0.4). Plain
// values.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace terrane::web {

// How many values were up to each bound.
struct Histogram {
    explicit Histogram(std::vector<double> ascendingBounds)
        : bounds(std::move(ascendingBounds)), counts(bounds.size()) {}
    void add(double value);

    std::vector<double> bounds;
    std::vector<std::uint64_t> counts;  // of values between a bound and the one before
    std::uint64_t count = 0;            // of all
    double sum = 0;
};

class MetricsText {
  public:
    // `name`: letters, digits and "_". `help`: one line.
    void counter(std::string_view name, std::string_view help, double value) {
        add(name, help, "counter", value);
    }
    void gauge(std::string_view name, std::string_view help, double value) {
        add(name, help, "gauge", value);
    }
    void histogram(std::string_view name, std::string_view help, const Histogram& histogram);
    // One more sample of the metric added last, with labels such as code="2xx".
    void sample(std::string_view name, std::string_view labels, double value);
    // Begins a metric that has samples with labels alone.
    void begin(std::string_view name, std::string_view help, std::string_view type);

    const std::string& text() const { return text_; }

  private:
    void add(std::string_view name, std::string_view help, std::string_view type, double value);

    std::string text_;
};

}  // namespace terrane::web
