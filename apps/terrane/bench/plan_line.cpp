#include "apps/terrane/bench/plan_line.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace terrane::app {

std::vector<Cell> expandLine(const std::string& line) {
    std::istringstream text(line);
    std::string command, flag, words;
    text >> command;
    std::vector<std::pair<std::string, std::string>> options;
    while (text >> flag >> words) {
        const auto known = std::ranges::find(options, flag, &std::pair<std::string, std::string>::first);
        if (known == options.end())
            options.emplace_back(flag, words);
        else
            known->second = words;
    }
    std::vector<Cell> cells = {{{command}}};
    for (const auto& [name, alternatives] : options) {
        std::vector<Cell> longer;
        for (const Cell& cell : cells) {
            std::istringstream list(alternatives);
            for (std::string word; std::getline(list, word, ',');) {
                longer.push_back(cell);
                longer.back().arguments.insert(longer.back().arguments.end(), {name, word});
            }
        }
        cells = std::move(longer);
    }
    return cells;
}

}  // namespace terrane::app
