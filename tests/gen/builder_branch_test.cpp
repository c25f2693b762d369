// if_ and variables against the same written with C++'s own `if`.
#include <gtest/gtest.h>

#include <utility>

#include <cstdint>

#include "terrane/shared/generation.h"
#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

using std::int32_t;

TEST(BuilderBranch, AVariableChangedInBothBranches) {
    expectNumbers(
        [](Pass& p) {
            Var<Int> v = p.var(p.x());
            p.if_((p.x() & 3) < 2, [&] { v = v + p.z(); }, [&] { v = v * 3; });
            return Int(v) & 0x7FFF;
        },
        [](int32_t x, int32_t, int32_t z) {
            const int32_t v = (x & 3) < 2 ? wrapped(int64_t{x} + z) : wrapped(int64_t{x} * 3);
            return v & 0x7FFF;
        });
}

TEST(BuilderBranch, AVariableChangedInOneBranchKeepsItsValueInTheOther) {
    expectNumbers(
        [](Pass& p) {
            Var<Int> v = p.var(Int(100)), w = p.var(p.z());
            p.if_((p.y() & 15) == 7, [&] { v = 200; });
            p.if_((p.x() & 1) == 0, {}, [&] { w = w + 5; });
            return v + w;
        },
        [](int32_t x, int32_t y, int32_t z) {
            return ((y & 15) == 7 ? 200 : 100) + ((x & 1) == 0 ? z : z + 5);
        });
}

// Rows of 16 columns: in rows of odd y no lane takes the branch, in others some do.
TEST(BuilderBranch, TakenBySomeLanesOfSomeRows) {
    expectNumbers(
        [](Pass& p) {
            Var<Int> v = p.var(Int(1));
            p.if_((p.y() & 1) == 0 && (p.x() & 15) > 11, [&] {
                v = v + (p.x() & 255) * (p.z() + 3);
                v = v * v;
            });
            return Int(v);
        },
        [](int32_t x, int32_t y, int32_t z) {
            if ((y & 1) != 0 || (x & 15) <= 11) return 1;
            const int64_t v = 1 + int64_t{x & 255} * (z + 3);
            return wrapped(v * v);
        });
}

TEST(BuilderBranch, NeverTaken) {
    expectNumbers(
        [](Pass& p) {
            Var<Int> v = p.var(p.z() * 2);
            p.if_(p.z() < 0, [&] { v = p.x() * p.y(); });
            p.if_(
                p.z() >= 0, [&] { v = v + 1; }, [&] { v = v + p.x() * 7; });
            return Int(v);
        },
        [](int32_t, int32_t, int32_t z) { return 2 * z + 1; });
}

TEST(BuilderBranch, ConditionsKnownBeforehand) {
    expectNumbers(
        [](Pass& p) {
            Var<Int> v = p.var(Int(1));
            p.if_(
                Bool(true), [&] { v = v + p.z(); }, [&] { v = 99; });
            p.if_(Bool(false), [&] { v = 98; });
            p.if_(
                Bool(false), [&] { v = 97; }, [&] { v = v * 2; });
            return Int(v);
        },
        [](int32_t, int32_t, int32_t z) { return 2 * (1 + z); });
}

TEST(BuilderBranch, Nested) {
    expectNumbers(
        [](Pass& p) {
            Var<Int> v = p.var(Int(0)), w = p.var(Int(10));
            p.if_((p.x() & 4) != 0,
                  [&] {
                      v = v + 1;
                      p.if_((p.y() & 2) != 0,
                            [&] {
                                w = w + v;
                                p.if_(
                                    p.z() > 128, [&] { v = v + w * 100; }, [&] { w = 7; });
                            },
                            [&] { v = w + p.z(); });
                      v = v + w;
                  },
                  [&] { p.if_(p.z() > 64, [&] { w = w * 3; }); });
            return v * 50 + w;
        },
        [](int32_t x, int32_t y, int32_t z) {
            int32_t v = 0, w = 10;
            if ((x & 4) != 0) {
                v = v + 1;
                if ((y & 2) != 0) {
                    w = w + v;
                    if (z > 128) {
                        v = v + w * 100;
                    } else {
                        w = 7;
                    }
                } else {
                    v = w + z;
                }
                v = v + w;
            } else if (z > 64) {
                w = w * 3;
            }
            return v * 50 + w;
        });
}

TEST(BuilderBranch, VariablesOfABranchEndWithIt) {
    expectNumbers(
        [](Pass& p) {
            Var<Int> outside = p.var(Int(0));
            p.if_((p.x() & 1) == 0,
                  [&] {
                      Var<Int> inside = p.var(p.z());
                      p.if_(p.z() > 9, [&] { inside = inside + 1000; });
                      outside = Int(inside);
                  },
                  [&] {
                      Var<Int> inside = p.var(Int(5)), second = p.var(Int(6));
                      p.if_(p.z() > 9, [&] { second = inside + 20; });
                      outside = inside + second;
                  });
            Var<Int> later = p.var(Int(1));
            p.if_(p.z() > 200, [&] { later = 2; });
            return outside + later * 2000;
        },
        [](int32_t x, int32_t, int32_t z) {
            const int32_t even = z > 9 ? z + 1000 : z, odd = z > 9 ? 30 : 11;
            return ((x & 1) == 0 ? even : odd) + (z > 200 ? 4000 : 2000);
        });
}

// An expression made in a branch is a value like any other: other code may use it.
TEST(BuilderBranch, ExpressionsOfABranchMayLeaveIt) {
    expectNumbers(
        [](Pass& p) {
            Int saved = 0;
            Var<Int> v = p.var(Int(3));
            p.if_((p.x() & 1) == 0, [&] {
                saved = p.z() * p.x();
                p.if_(p.z() > 50, [&] { v = 4; });
                saved = saved + v;
                v = saved;
            });
            return saved - v;
        },
        [](int32_t x, int32_t, int32_t z) {
            const int32_t saved = wrapped(int64_t{z} * x + (z > 50 ? 4 : 3));
            return wrapped(int64_t{saved} - ((x & 1) == 0 ? saved : 3));
        });
}

// Two variables that swap: each phi must read what the other had before.
TEST(BuilderBranch, VariablesMaySwap) {
    expectNumbers(
        [](Pass& p) {
            Var<Int> a = p.var(p.x() & 63), b = p.var(p.z() * 7), c = p.var(p.y() & 31);
            for (int k = 0; k < 3; ++k) {
                p.if_(((p.x() + p.z()) & (1 << k)) != 0,
                      [&] {
                          const Int before = a;
                          a = b;
                          b = c;
                          c = before;
                      },
                      [&] {
                          const Int before = b;
                          b = a;
                          a = before + 1;
                      });
            }
            return a + b * 3 + c * 11;
        },
        [](int32_t x, int32_t y, int32_t z) {
            int32_t a = x & 63, b = z * 7, c = y & 31;
            for (int k = 0; k < 3; ++k) {
                if ((wrapped(int64_t{x} + z) & (1 << k)) != 0) {
                    const int32_t before = a;
                    a = b;
                    b = c;
                    c = before;
                } else {
                    const int32_t before = b;
                    b = a;
                    a = before + 1;
                }
            }
            return a + b * 3 + c * 11;
        });
}

TEST(BuilderBranch, VariablesOfEveryType) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            g.pass3D("types", [](Pass& p) {
                Var<Float> f = p.var(Float(0.25f));
                Var<Bool> b = p.var(Bool(false));
                Var<Block> block = p.var(p.block("stone"));
                p.if_((p.x() & 2) != 0, [&] {
                    f = f + Float(p.z()) * 0.5f;
                    b = p.z() > 20;
                });
                p.if_(Bool(b) && Float(f) < 40.0f, [&] { block = p.block("dirt"); });
                p.if_(!Bool(b) && Float(f) > 5.0f, [&] { block = p.block("water"); });
                p.setBlock(block);
            });
        },
        [](int32_t x, int32_t, int32_t z) {
            const float f = (x & 2) != 0 ? 0.25f + static_cast<float>(z) * 0.5f : 0.25f;
            const bool b = (x & 2) != 0 && z > 20;
            if (b && f < 40.0f) return 2;
            return !b && f > 5.0f ? 3 : 1;
        });
}

// Values that are equal in a layer, in a branch that only some columns take, and the other way round.
TEST(BuilderBranch, ValuesThatVaryAndValuesThatDoNot) {
    expectNumbers(
        [](Pass& p) {
            Var<Int> layer = p.var(Int(0)), column = p.var(Int(0));
            p.if_((p.x() & 1) == 0, [&] { layer = p.z() * p.z() + 7; });
            p.if_((p.z() & 1) == 0, [&] { column = (p.x() & 255) * 3 + 1; }, [&] { column = p.z() + 2; });
            p.if_(p.z() < 30, [&] { p.if_(p.z() > 20, [&] { column = column + 5000; }); });
            return layer + column;
        },
        [](int32_t x, int32_t, int32_t z) {
            const int32_t layer = (x & 1) == 0 ? z * z + 7 : 0;
            const int32_t column = (z & 1) == 0 ? (x & 255) * 3 + 1 : z + 2;
            return layer + column + (z < 30 && z > 20 ? 5000 : 0);
        });
}

// Loops

TEST(BuilderLoops, EachLaneStopsByItself) {
    // Steps of the Collatz sequence down to 1.
    expectNumbers(
        [](Pass& p) {
            Var<Int> n = p.var((p.x() & 31) + p.z() + 1), steps = p.var(Int(0));
            p.while_([&] { return n != Int(1); },
                     [&] {
                         n = select((n & Int(1)) == 0, n >> 1, Int(n) * 3 + 1);
                         steps = steps + 1;
                     });
            return Int(steps);
        },
        [](int32_t x, int32_t, int32_t z) {
            int steps = 0;
            for (int n = (x & 31) + z + 1; n != 1; ++steps) n = n % 2 == 0 ? n / 2 : n * 3 + 1;
            return steps;
        });
}

TEST(BuilderLoops, VariablesChangeAtOnce) {
    // Fibonacci numbers by exchange: each next value is another variable's.
    expectNumbers(
        [](Pass& p) {
            Var<Int> a = p.var(Int(0)), b = p.var(Int(1)), left = p.var(p.z() & 15);
            p.while_([&] { return left > 0; },
                     [&] {
                         const Int sum = a + b;
                         a = static_cast<Int>(b);
                         b = sum;
                         left = left - 1;
                     });
            return Int(a);
        },
        [](int32_t, int32_t, int32_t z) {
            int a = 0, b = 1;
            for (int k = z & 15; k > 0; --k) b = std::exchange(a, b) + b;
            return a;
        });
}

TEST(BuilderLoops, AVariableThatIsMadeInALoopEndsWithIt) {
    expectNumbers(
        [](Pass& p) {
            Var<Int> n = p.var(Int(0)), left = p.var(p.z() & 3);
            const auto loop = [&] {
                p.while_([&] { return left > 0; },
                         [&] {
                             Var<Int> next = p.var(Int(0));
                             next = n + 2;
                             n = static_cast<Int>(next);
                             left = left - 1;
                         });
            };
            loop();
            p.if_(n > 2, [&] { n = n + 100; });
            left = Int(1);
            loop();
            return Int(n);
        },
        [](int32_t, int32_t, int32_t z) {
            const int n = 2 * (z & 3);
            return (n > 2 ? n + 100 : n) + 2;
        });
}

TEST(BuilderLoops, ALoopWithoutAnEndEnds) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            const auto rounds = g.field<Int>("rounds");
            g.pass2D("loop", [&](Pass& p) {
                Var<Int> n = p.var(Int(0));
                p.while_([] { return Bool(true); }, [&] { n = n + 1; });
                p.set(rounds, static_cast<Int>(n));
            });
            g.pass3D("result", [&](Pass& p) { p.setBlock(Block(p.read(rounds))); });
        },
        [](int32_t, int32_t, int32_t) { return shared::kMaxLoopRounds; });
}

TEST(BuilderLoops, LoopsInLoopsInBranches) {
    expectNumbers(
        [](Pass& p) {
            Var<Int> sum = p.var(Int(0));
            p.if_((p.x() & 1) == 0, [&] {
                Var<Int> i = p.var(Int(0));
                p.while_([&] { return i < (p.z() & 7); },
                         [&] {
                             Var<Int> j = p.var(Int(0));
                             p.while_([&] { return j < i; },
                                      [&] {
                                          p.if_(((i + j) & 1) == 0, [&] { sum = sum + i * j + 1; });
                                          j = j + 1;
                                      });
                             i = i + 1;
                         });
            });
            return Int(sum);
        },
        [](int32_t x, int32_t, int32_t z) {
            int sum = 0;
            for (int i = 0; i < (z & 7) && x % 2 == 0; ++i) {
                for (int j = 0; j < i; ++j) sum += (i + j) % 2 == 0 ? i * j + 1 : 0;
            }
            return sum;
        });
}

// The highest stone of the column, found from above; in a 2D pass.
TEST(BuilderLoops, ASearchDownAColumn) {
    expectBlocks(
        [](GeneratorBuilder& g) {
            const auto top = g.field<Int>("top");
            g.pass3D("ground", [](Pass& p) {
                p.setBlock(select(p.z() <= (p.x() & 63) + 20, p.block("stone"), p.block("air")));
            });
            g.pass2D("search", [&](Pass& p) {
                Var<Int> z = p.var(Int(255));
                p.while_([&] { return z > 0 && p.blockInColumn(z) == p.block("air"); }, [&] { z = z - 1; });
                p.set(top, static_cast<Int>(z));
            });
            g.pass3D("result", [&](Pass& p) { p.setBlock(Block(p.read(top))); });
        },
        [](int32_t x, int32_t, int32_t) { return (x & 63) + 20; });
}

}  // namespace
}  // namespace terrane::gen
