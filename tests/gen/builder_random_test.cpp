// Random programs with variables and nested ifs, written through the builder, against an interpreter that
// runs them statement by statement. It knows nothing of graphs: folding, sharing and scheduling are tested.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/gen/pass_runner.h"
#include "tests/gen/random_graph.h"

namespace terrane::gen {
namespace {

// An expression: an operation with arguments, or a leaf.
struct Term {
    enum Kind : std::uint8_t { Operation, Literal, Position, Field, Variable };
    Kind kind = Literal;
    Op op = Op::Constant;
    Type type = Type::Int;
    Bits literal = 0;
    std::uint32_t number = 0;  // axis, field or variable
    std::vector<Term> args;
};

struct Statement {
    std::uint32_t variable = 0;  // of an assignment
    Term value;                  // assigned, or the condition
    enum Kind : std::uint8_t { Assignment, If, While };
    Kind kind = Assignment;
    std::vector<Statement> then, otherwise;  // a loop's body is `then`
    std::int32_t rounds = 0;                 // a loop ends after so many
};
using StatementList = std::vector<Statement>;

constexpr std::array<Type, 6> kVariables = {Type::Int,   Type::Int,  Type::Float,
                                            Type::Float, Type::Bool, Type::Bool};
constexpr std::array<Type, 3> kFields = {Type::Float, Type::Int, Type::Bool};

class RandomProgram {
  public:
    explicit RandomProgram(std::uint32_t seed) : random_(seed) {}

    StatementList statements(int depth, std::uint32_t count) {
        StatementList block;
        for (std::uint32_t k = 0; k < count; ++k) block.push_back(statement(depth));
        return block;
    }

  private:
    std::uint32_t below(std::uint32_t n) { return random_() % n; }

    Statement statement(int depth) {
        Statement s;
        if (depth < 2 && below(8) == 0) {
            s.kind = Statement::While;
            s.value = term(Type::Bool, 3);
            s.then = statements(depth + 2, 1 + below(3));
            s.rounds = static_cast<std::int32_t>(below(6));
        } else if (depth < 4 && below(3) == 0) {
            s.kind = Statement::If;
            s.value = term(Type::Bool, 3);
            s.then = statements(depth + 1, below(4));
            s.otherwise = statements(depth + 1, below(3));
        } else {
            s.variable = below(kVariables.size());
            s.value = term(kVariables[s.variable], 4);
        }
        return s;
    }

    Term term(Type type, int depth) {
        return depth == 0 || below(4) == 0 ? leaf(type) : operation(type, depth);
    }

    Term leaf(Type type) {
        Term t;
        t.type = type;
        const std::uint32_t choice = below(5);
        if (choice == 0) {
            t.literal = randomBits(type, random_);
        } else if (choice == 1 && type == Type::Int) {
            t.kind = Term::Position;
            t.number = below(3);
        } else if (choice == 2) {
            t.kind = Term::Field;
            t.number = type == Type::Float ? 0 : type == Type::Int ? 1 : 2;
        } else {
            t.kind = Term::Variable;
            t.number = (type == Type::Int ? 0 : type == Type::Float ? 2 : 4) + below(2);
        }
        return t;
    }

    Term operation(Type type, int depth) {
        const auto first = static_cast<std::uint32_t>(Op::AddF), end = static_cast<std::uint32_t>(Op::Phi);
        Term t;
        t.kind = Term::Operation;
        t.type = type;
        do {
            t.op = static_cast<Op>(first + below(end - first));
        } while (t.op != Op::Select && record(t.op).result != type);
        const OpRecord& r = record(t.op);
        for (std::size_t k = 0; k < r.argCount; ++k) {
            t.args.push_back(term(t.op == Op::Select && k > 0 ? type : r.argTypes[k], depth - 1));
        }
        return t;
    }

    std::mt19937 random_;
};

class Interpreter {
  public:
    Interpreter(const PassRunner& runner, world::BlockPos at) : runner_(runner), at_(at) {}

    void run(const StatementList& block) {
        for (const Statement& s : block) {
            if (s.kind == Statement::Assignment) variables[s.variable] = evaluate(s.value);
            if (s.kind == Statement::If) run(asBool(evaluate(s.value)) ? s.then : s.otherwise);
            if (s.kind != Statement::While) continue;
            for (int round = 0; round < s.rounds && asBool(evaluate(s.value)); ++round) run(s.then);
        }
    }

    std::array<Bits, kVariables.size()> variables{};

  private:
    Bits evaluate(const Term& t) const {
        const std::array<std::int32_t, 3> position = {at_.x, at_.y, at_.z};
        const auto lane = static_cast<std::size_t>((at_.x & 15) + 16 * (at_.y & 15));
        switch (t.kind) {
            case Term::Literal:
                return t.literal;
            case Term::Position:
                return bitsOf(position[t.number]);
            case Term::Field:
                return runner_.fields[t.number][lane];
            case Term::Variable:
                return variables[t.number];
            case Term::Operation:
                break;
        }
        std::vector<Bits> args;
        for (const Term& arg : t.args) args.push_back(evaluate(arg));
        return record(t.op).evaluate(args);
    }

    const PassRunner& runner_;
    world::BlockPos at_;
};

// Writes the same statements through the builder.
class Writer {
  public:
    Writer(Pass& p, Field<Float> f, Field<Int> i, Field<Bool> b) : pass_(p), float_(f), int_(i), bool_(b) {
        for (std::size_t k = 0; k < 2; ++k) {
            ints_[k].reset(new Var<Int>(p.var(Int(0))));
            floats_[k].reset(new Var<Float>(p.var(Float(0.0f))));
            bools_[k].reset(new Var<Bool>(p.var(Bool(false))));
        }
    }

    void write(const StatementList& block) {
        for (const Statement& s : block) {
            if (s.kind == Statement::If) {
                pass_.if_(
                    Bool(term(s.value)), [&] { write(s.then); }, [&] { write(s.otherwise); });
            } else if (s.kind == Statement::While) {
                Var<Int> round = pass_.var(Int(0));
                pass_.while_([&] { return round < s.rounds && Bool(term(s.value)); },
                             [&] {
                                 write(s.then);
                                 round = round + 1;
                             });
            } else {
                assign(s.variable, term(s.value));
            }
        }
    }

    // The variables as one number: floats by what they compare to.
    Int result() {
        Int sum = variable<Int>(0) * 31 + variable<Int>(1);
        for (std::uint32_t k = 0; k < 2; ++k) {
            const Float f = variable<Float>(k + 2);
            sum = sum * 31 + Int(f) + select(f < 1.5f, Int(1), Int(0)) + select(f == 0.0f, Int(2), Int(0));
            sum = sum * 31 + select(variable<Bool>(k + 4), Int(5), Int(0));
        }
        return sum;
    }

  private:
    template <class T>
    T variable(std::uint32_t number) {
        if constexpr (T::kType == Type::Int) return *ints_[number];
        if constexpr (T::kType == Type::Float) return *floats_[number - 2];
        if constexpr (T::kType == Type::Bool) return *bools_[number - 4];
    }

    void assign(std::uint32_t number, Value v) {
        if (kVariables[number] == Type::Int) *ints_[number] = Int(v);
        if (kVariables[number] == Type::Float) *floats_[number - 2] = Float(v);
        if (kVariables[number] == Type::Bool) *bools_[number - 4] = Bool(v);
    }

    Value term(const Term& t) {
        switch (t.kind) {
            case Term::Literal:
                return {nullptr, t.literal};
            case Term::Position:
                return t.number == 0 ? pass_.x() : t.number == 1 ? pass_.y() : pass_.z();
            case Term::Field:
                if (t.type == Type::Float) return pass_.read(float_);
                return t.type == Type::Int ? Value(pass_.read(int_)) : Value(pass_.read(bool_));
            case Term::Variable:
                if (t.type == Type::Float) return variable<Float>(t.number);
                return t.type == Type::Int ? Value(variable<Int>(t.number)) : Value(variable<Bool>(t.number));
            case Term::Operation:
                break;
        }
        std::array<Value, 3> args;
        for (std::size_t k = 0; k < t.args.size(); ++k) args[k] = term(t.args[k]);
        if (t.args.size() == 1) return applyOp(t.op, t.type, {args[0]});
        if (t.args.size() == 2) return applyOp(t.op, t.type, {args[0], args[1]});
        return applyOp(t.op, t.type, {args[0], args[1], args[2]});
    }

    Pass& pass_;
    Field<Float> float_;
    Field<Int> int_;
    Field<Bool> bool_;
    std::array<std::unique_ptr<Var<Int>>, 2> ints_;
    std::array<std::unique_ptr<Var<Float>>, 2> floats_;
    std::array<std::unique_ptr<Var<Bool>>, 2> bools_;
};

// As Writer::result has it.
std::uint32_t resultOf(const std::array<Bits, kVariables.size()>& v) {
    std::uint32_t sum = v[0] * 31 + v[1];
    for (std::size_t k = 0; k < 2; ++k) {
        const Bits f = v[k + 2];
        const std::array<Bits, 1> args = {f};
        sum = sum * 31 + record(Op::FloatToInt).evaluate(args) + (asFloat(f) < 1.5f ? 1 : 0) +
              (asFloat(f) == 0.0f ? 2 : 0);
        sum = sum * 31 + (v[k + 4] != 0 ? 5 : 0);
    }
    return sum;
}

GeneratorGraph written(const StatementList& program) {
    return build([&](GeneratorBuilder& g) {
        const auto f = g.field<Float>("f");
        const auto i = g.field<Int>("i");
        const auto b = g.field<Bool>("b");
        g.pass2D("inputs", [&](Pass& p) {
            p.set(f, Float(0.0f));
            p.set(i, Int(0));
            p.set(b, Bool(false));
        });
        g.pass3D("random", [&](Pass& p) {
            Writer writer(p, f, i, b);
            writer.write(program);
            p.setBlock(Block(writer.result()));
        });
    });
}

void expectSame(const PassRunner& runner, const StatementList& program, const BlockArray& blocks) {
    for (std::size_t index = 0; index < blocks.size(); index += 61) {  // every column, many layers
        const world::BlockPos at = world::blockPos(runner.chunk, static_cast<world::BlockIndex>(index));
        Interpreter interpreter(runner, at);
        interpreter.run(program);
        ASSERT_EQ(blocks[index], static_cast<std::uint16_t>(resultOf(interpreter.variables)))
            << "at (" << at.x << ", " << at.y << ", " << at.z << ")";
    }
}

TEST(BuilderRandom, ProgramsRunAsTheyAreWritten) {
    for (std::uint32_t seed = 0; seed < kRandomCases; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const StatementList program = RandomProgram(seed).statements(0, 12);
        PassRunner runner(written(program));
        std::mt19937 random(seed);
        runner.chunk = kPlaces[seed % kPlaces.size()];
        for (std::size_t k = 0; k < kFields.size(); ++k) runner.fields[k] = randomColumns(kFields[k], random);
        ASSERT_NO_FATAL_FAILURE(expectSame(runner, program, *runner.run3D(1)));
    }
}

}  // namespace
}  // namespace terrane::gen
