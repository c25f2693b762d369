#include "apps/terrane/bench/measurement.h"

#include <cassert>

#include "apps/terrane/median.h"

namespace terrane::app {

using nlohmann::json;

std::string keyOf(const Cell& cell) {
    std::string key;
    for (const std::string& argument : cell.arguments) key += (key.empty() ? "" : " ") + argument;
    return key;
}

json medianOf(std::span<const json> runs) {
    assert(!runs.empty() && "nothing has no median");
    const json& first = runs.front();
    if (first.is_number()) {
        std::vector<double> numbers;
        for (const json& run : runs)
            if (run.is_number()) numbers.push_back(run.get<double>());
        return medianOf(std::move(numbers));
    }
    if (!first.is_object()) return first;
    std::map<std::string, std::vector<json>> members;
    for (const json& run : runs) {
        if (!run.is_object()) continue;
        for (const auto& [key, value] : run.items()) members[key].push_back(value);
    }
    json result = json::object();
    for (const auto& [key, values] : members) result[key] = medianOf(values);
    return result;
}

namespace {

std::optional<double> numberAt(const json& measurement, const std::string& text) {
    const json::json_pointer pointer(text);
    if (!measurement.contains(pointer) || !measurement.at(pointer).is_number()) return std::nullopt;
    return measurement.at(pointer).get<double>();
}

}  // namespace

std::optional<double> valueIn(const json& measurement, const Value& value) {
    auto number = numberAt(measurement, value.pointer);
    if (!value.per.empty()) {
        const auto per = numberAt(measurement, value.per);
        if (!per || *per == 0) return std::nullopt;
        if (number) *number /= *per;
    }
    if (!number || (value.isInverse && *number == 0)) return std::nullopt;
    return value.isInverse ? value.factor / *number : value.factor * *number;
}

std::optional<json> Measurements::find(const Cell& cell) const {
    const auto found = runs.find(keyOf(cell));
    if (found == runs.end() || found->second.empty()) return std::nullopt;
    return medianOf(found->second);
}

std::string_view Measurements::failureOf(const Cell& cell) const {
    const auto found = failures.find(keyOf(cell));
    return found == failures.end() ? std::string_view() : found->second;
}

}  // namespace terrane::app
