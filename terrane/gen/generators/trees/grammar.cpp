#include "terrane/gen/generators/trees/grammar.h"

#include <cassert>

namespace terrane::gen::trees {
namespace {

Point cross(Point a, Point b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

float dot(Point a, Point b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// `left` and `ahead` are perpendicular and have length 1.
struct Turtle {
    Point at = {0, 0, 0};
    Point ahead = {0, 0, 1}, left = {0, 1, 0};
    float step = 1;
    int node = -1;
};

void straighten(Turtle& t) {
    t.ahead = normalized(t.ahead);
    t.left = normalized(t.left - t.ahead * dot(t.left, t.ahead));
}

// Turns `from` toward `to`, which is perpendicular to it.
Point turned(Point from, Point to, float turns) {
    return from * sinTurns(turns + .25f) + to * sinTurns(turns);
}

void turnSideways(Turtle& t, float turns) {
    const Point ahead = t.ahead;
    t.ahead = turned(ahead, t.left, turns);
    t.left = turned(t.left, ahead * -1.0f, turns);
    straighten(t);
}

void turnDown(Turtle& t, float turns) {
    t.ahead = turned(t.ahead, cross(t.left, t.ahead), turns);
    straighten(t);
}

void roll(Turtle& t, float turns) {
    t.left = turned(t.left, cross(t.ahead, t.left), turns);
    straighten(t);
}

void advance(Turtle& t, Branches& branches, const Grammar& grammar, float length) {
    t.at = t.at + t.ahead * length;
    branches.push_back({t.at, t.node});
    t.node = static_cast<int>(branches.size() - 1);
    t.ahead = t.ahead + grammar.tropism;
    straighten(t);
}

// Returns the word that takes the symbol's place: by `share` in 0…1 among its rules, else itself.
std::string_view replacement(const char& symbol, std::span<const Rule> rules, float share) {
    for (const Rule& rule : rules) {
        if (rule.symbol != symbol) continue;
        if (share < rule.chance) return rule.becomes;
        share -= rule.chance;
    }
    return {&symbol, 1};
}

}  // namespace

std::string rewritten(std::string_view axiom, std::span<const Rule> rules, int rounds, Random& random) {
    std::string word(axiom);
    for (int round = 0; round < rounds && word.size() < kMaxSymbols; ++round) {
        std::string next;
        for (const char& symbol : word) next += replacement(symbol, rules, random.unit());
        word = std::move(next);
    }
    return word;
}

Growth growByGrammar(const Grammar& grammar, Random& random) {
    Growth growth;
    // The part in the earth.
    addLine(growth.branches, -1, kRootEnd, {0, 0, 0});
    Turtle turtle;
    turtle.step = grammar.step;
    turtle.node = static_cast<int>(growth.branches.size() - 1);
    roll(turtle, random.unit());
    std::vector<Turtle> places;
    for (const char symbol : rewritten(grammar.axiom, grammar.rules, grammar.rounds, random)) {
        const float differs = 1.0f + grammar.chance * random.between(-1.0f, 1.0f);
        const float angle = grammar.angle * differs;
        if (symbol == 'F') advance(turtle, growth.branches, grammar, turtle.step * differs);
        if (symbol == '&') turnDown(turtle, angle);
        if (symbol == '^') turnDown(turtle, -angle);
        if (symbol == '+') turnSideways(turtle, angle);
        if (symbol == '-') turnSideways(turtle, -angle);
        if (symbol == '/') roll(turtle, grammar.roll * differs);
        if (symbol == '\'') turtle.step *= grammar.shrink;
        if (symbol == 'L') growth.tufts.push_back({turtle.at, turtle.ahead});
        if (symbol == '[') places.push_back(turtle);
        if (symbol == ']') {
            assert(!places.empty() && "a grammar closes only brackets that it opened");
            turtle = places.back();
            places.pop_back();
        }
    }
    return growth;
}

}  // namespace terrane::gen::trees
