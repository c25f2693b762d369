// Metrics in the text format of Prometheus (prometheus.io, "Exposition formats", version 0.0.4). All are
// plain values.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace terrane::web {

// Counts of values between ascending bounds.
struct Histogram {
    explicit Histogram(std::vector<double> ascendingBounds)
        : bounds(std::move(ascendingBounds)), counts(bounds.size()) {}
    void add(double value);

    std::vector<double> bounds;
    std::vector<std::uint64_t> counts;  // values above the previous bound and up to this one
    std::uint64_t count = 0;            // all values
    double sum = 0;
};

class MetricsText {
  public:
    // Add a counter or a gauge. `name` has letters, digits and "_"; `help` is one line.
    void counter(std::string_view name, std::string_view help, double value) {
        add(name, help, "counter", value);
    }
    void gauge(std::string_view name, std::string_view help, double value) {
        add(name, help, "gauge", value);
    }
    void histogram(std::string_view name, std::string_view help, const Histogram& histogram);
    // Adds a sample to the last metric, with labels such as code="2xx".
    void sample(std::string_view name, std::string_view labels, double value);
    // Begins a metric whose samples all have labels.
    void begin(std::string_view name, std::string_view help, std::string_view type);

    const std::string& text() const { return text_; }

  private:
    void add(std::string_view name, std::string_view help, std::string_view type, double value);

    std::string text_;
};

}  // namespace terrane::web
