#include "terrane/gen/generators/ruins.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "terrane/gen/generators/trees/canvas.h"
#include "terrane/gen/generators/trees/grammar.h"

namespace terrane::gen::ruins {

namespace {

using trees::Canvas;
using trees::Point;
using trees::Random;
using trees::Rule;

constexpr int kVariants = 10, kSegment = 3;  // blocks of wall a symbol
constexpr int kRuinRank = 2;                 // stays where trees stand in it
constexpr int kFoundation = -6;              // z down to which walls reach, so that they stand on slopes

// A builder walks along walls and turns at their corners:
//
//     W D O B  three blocks of wall: whole, with a door, with a window, broken down
//     C        a column instead of wall                +  turns left by a quarter
//     T        a tower around the place                [ ] remembers and returns to a place
//
// S is a side of a room, three segments long, H a house, R a further room on the other side of the wall.
constexpr Rule kRules[] = {
    {'H', .40f, "S+S[-R]+S+S"}, {'H', .30f, "TS+S+TS[R]+S"}, {'H', .30f, "K+K+K+K[R]"},
    {'R', .45f, "S-S-S-S"},     {'R', .30f, "S-K-S-S"},      {'R', .25f, "B"},
    {'S', .26f, "WDW"},         {'S', .24f, "WOW"},          {'S', .20f, "WWB"},
    {'S', .18f, "OWO"},         {'S', .12f, "BWW"},          {'K', .60f, "CCC"},
    {'K', .40f, "CBC"},
};

struct Walker {
    int x, y, turn;  // quarters; 0 is +x
};

struct Paints {
    Canvas::Paint bricks, cobble, moss, column;
};

class Mason {
  public:
    Mason(Canvas& canvas, Random& random)
        : canvas_(canvas),
          random_(random),
          paints_{canvas.paint("stone_bricks", kRuinRank), canvas.paint("cobble", kRuinRank),
                  canvas.paint("mossy_stone", kRuinRank), canvas.paint("sandstone", kRuinRank)},
          height_(random.between(4, 7)) {}

    void build(const std::string& plan) {
        Walker at = {-4, -4, 0};
        std::vector<Walker> places;
        for (const char symbol : plan) {
            switch (symbol) {
                case '+':
                    at.turn = (at.turn + 1) % 4;
                    break;
                case '-':
                    at.turn = (at.turn + 3) % 4;
                    break;
                case '[':
                    places.push_back(at);
                    break;
                case ']':
                    if (!places.empty()) {
                        at = places.back();
                        places.pop_back();
                    }
                    break;
                case 'T':
                    tower(at.x, at.y);
                    break;
                default:
                    wall(at, symbol);
                    break;
            }
        }
    }

    // Stones lie about.
    void rubble(int count) {
        for (int k = 0; k < count; ++k) {
            const int x = random_.between(-12, 12), y = random_.between(-12, 12);
            const int high = random_.unit() < .3f ? 1 : 0;
            for (int z = kFoundation; z <= high; ++z) canvas_.set(x, y, z, stone(z));
        }
    }

  private:
    Canvas::Paint stone(int z) {
        const float chance = random_.unit();
        if (chance < (z < 2 ? .35f : .15f)) return paints_.moss;
        return chance < .5f ? paints_.cobble : paints_.bricks;
    }

    // A pillar of wall, open between two heights.
    void post(int x, int y, int height, int openFrom = 0, int openTo = 0) {
        for (int z = kFoundation; z < height; ++z)
            if (z < openFrom || z >= openTo) canvas_.set(x, y, z, stone(z));
    }

    void wall(Walker& at, char symbol) {
        constexpr int kX[] = {1, 0, -1, 0}, kY[] = {0, 1, 0, -1};
        static constexpr std::string_view kSymbols = "WDOBC";
        if (kSymbols.find(symbol) == std::string_view::npos) return;
        for (int k = 0; k < kSegment; ++k, at.x += kX[at.turn], at.y += kY[at.turn]) {
            const int worn = random_.between(0, 3), height = std::max(1, height_ - worn);
            const bool isMiddle = k == 1;
            if (symbol == 'C') {
                column(at.x, at.y, k > 0 ? 0 : random_.unit() < .6f ? height_ + 2 : worn + 1);
            } else if (symbol == 'B') {
                post(at.x, at.y, random_.between(0, 2));
            } else if (symbol == 'D' && isMiddle) {
                post(at.x, at.y, height > 3 ? 4 : 0, 0, 3);
            } else if (symbol == 'O' && isMiddle) {
                post(at.x, at.y, height, 1, 3);
            } else {
                post(at.x, at.y, height);
            }
        }
    }

    void column(int x, int y, int height) {
        for (int z = kFoundation; z < height; ++z) canvas_.set(x, y, z, paints_.column);
    }

    void tower(int x, int y) {
        const int height = random_.between(9, 15);
        for (int dy = -2; dy <= 2; ++dy) {
            for (int dx = -2; dx <= 2; ++dx) {
                const bool isWall = std::max(std::abs(dx), std::abs(dy)) == 2;
                const bool isCorner = std::abs(dx) == 2 && std::abs(dy) == 2;
                if (isCorner) continue;
                const int worn = dx + dy + random_.between(0, 3);  // one side has fallen down
                const bool isDoor = dx == 2 && dy == 0;
                post(x + dx, y + dy, isWall ? std::max(4, height - std::max(0, worn) * 2) : 0, 0,
                     isDoor ? 3 : 0);
            }
        }
    }

    Canvas& canvas_;
    Random& random_;
    Paints paints_;
    int height_;
};

std::vector<VoxelShape> drawn() {
    std::vector<VoxelShape> result;
    for (int variant = 0; variant < kVariants; ++variant) {
        Canvas canvas;
        Random random(static_cast<std::uint32_t>(77000 + variant));
        Mason mason(canvas, random);
        mason.rubble(26);
        mason.build(trees::rewritten("H", kRules, 3, random));
        // The middle holds the shape's foot, so that no part hangs in the air where columns are wide.
        for (int z = kFoundation; z <= 0; ++z) canvas.set(0, 0, z, canvas.paint("mossy_stone", kRuinRank));
        result.push_back(canvas.shape("ruins " + std::to_string(variant)));
    }
    return result;
}

}  // namespace

const std::vector<VoxelShape>& shapes() {
    static const std::vector<VoxelShape> all = drawn();
    return all;
}

RuinRecord record(GeneratorBuilder& g) {
    RuinRecord ruins;
    for (const VoxelShape& shape : shapes()) {
        const int number = g.shape(shape);
        if (ruins.first < 0) ruins.first = number;
        ++ruins.count;
    }
    return ruins;
}

Int shapeOf(const RuinRecord& ruins, Int hash) {
    return (((hash >> 8) & 0xFFFF) * ruins.count >> 16) + ruins.first;
}

}  // namespace terrane::gen::ruins
