// What `terrane bench` measures: runs of the program itself, each in a process of its own, and what they
// print.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace terrane::app {

using Arguments = std::vector<std::string>;

// One run of the program. Equal arguments are one measurement, whichever tables show it.
struct Cell {
    Arguments arguments;
    Arguments before = {};  // a run that must have been made before, once, and is not measured; empty: none
};

// As on a command line. What a measurement is kept under.
std::string keyOf(const Cell& cell);

// Each number is the median over the runs that have it; all else is as in the first run that has it.
nlohmann::json medianOf(std::span<const nlohmann::json> runs);

// A number in a measurement: where it is, and what makes it the figure that is shown.
struct Value {
    std::string pointer;  // JSON pointer
    double factor = 1;
    bool isInverse = false;  // factor / number
    std::string per = {};    // JSON pointer to what it is divided by; empty: nothing
};
std::optional<double> valueIn(const nlohmann::json& measurement, const Value& value);

// All that was measured so far, by key.
struct Measurements {
    std::map<std::string, std::vector<nlohmann::json>> runs;
    std::map<std::string, std::string> failures;  // why there are no runs

    // Over all runs; none where there are none.
    std::optional<nlohmann::json> find(const Cell& cell) const;
    std::string_view failureOf(const Cell& cell) const;  // empty: none
};

}  // namespace terrane::app
