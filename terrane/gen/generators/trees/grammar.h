// Plants by rewriting grammars, L-systems: P. Prusinkiewicz, A. Lindenmayer, The Algorithmic Beauty of
// Plants, 1990, 1.3 to 1.7. A grammar is data: a word, rules with chances, numbers. Its last word steers a
// turtle that leaves branches behind (branching.h). The same bits on every machine.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/gen/generators/trees/branching.h"

namespace terrane::gen::trees {

struct Rule {
    char symbol;
    float chance;  // the chances of a symbol's rules are at most 1; the rest keeps the symbol
    std::string_view becomes;
};

// Replaces all symbols that have rules, `rounds` times. The result has at most about kMaxSymbols symbols.
constexpr std::size_t kMaxSymbols = 20000;
std::string rewritten(std::string_view axiom, std::span<const Rule> rules, int rounds, Random& random);

// The turtle starts at the foot and looks up.
//
//     F      one step ahead, with a branch     [ ]  remember and return to a place
//     & ^    turn down, up by `angle`          '    shorter steps from here on, times `shrink`
//     + -    turn left, right by `angle`       L    a leaf or a tuft of leaves
//     /      roll by `roll` about its own axis
//
// All other symbols do nothing.
struct Grammar {
    std::string_view axiom;
    std::span<const Rule> rules;
    int rounds = 1;
    float step = 1;             // blocks
    float angle = .1f;          // turns
    float roll = .382f;         // turns; the golden angle, so that branches do not lie above each other
    float shrink = .8f;         // of steps
    float chance = .2f;         // share by which steps and angles differ
    Point tropism = {0, 0, 0};  // added to the direction after each step
};

struct Tuft {
    Point at, along;  // `along` has length 1
};

struct Growth {
    Branches branches;
    std::vector<Tuft> tufts;
};

Growth growByGrammar(const Grammar& grammar, Random& random);

}  // namespace terrane::gen::trees
