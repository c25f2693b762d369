#include "terrane/gen/glsl_emitter.h"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "terrane/gen/schedule.h"

namespace terrane::gen {
namespace {

const char* typeName(Type type) {
    switch (type) {
        case Type::Bool:
            return "bool";
        case Type::Int:
            return "int";
        case Type::Float:
            return "precise float";  // no contraction, no reordering: the same bits as on the CPU
    }
    return "";
}

std::string literal(Type type, Bits bits) {
    if (type == Type::Bool) return asBool(bits) ? "true" : "false";
    // As bits, since compilers read decimal fractions with different roundings.
    if (type == Type::Float) return fmt::format("uintBitsToFloat({:#x}u) /* {} */", bits, asFloat(bits));
    return asInt(bits) < 0 ? fmt::format("int({:#x}u)", bits) : fmt::format("{}", bits);
}

// How a field's 32 bits become a value of its type, and back.
std::string fromBits(Type type, const std::string& bits) {
    if (type == Type::Bool) return bits + " != 0u";
    return type == Type::Float ? "uintBitsToFloat(" + bits + ")" : "int(" + bits + ")";
}

std::string toBits(Type type, const std::string& value) {
    if (type == Type::Bool) return value + " ? ~0u : 0u";
    return type == Type::Float ? "floatBitsToUint(" + value + ")" : "uint(" + value + ")";
}

class Emitter {
  public:
    Emitter(const GeneratorGraph& generator, std::size_t pass)
        : generator_(generator),
          pass_(generator.passes[pass]),
          graph_(pass_.graph),
          names_(graph_.size()),
          known_(graph_.size(), false) {}

    std::string run() {
        nameLeaves();
        std::vector<NodeId> outputs;
        for (const FieldOutput& f : pass_.fields) outputs.push_back(f.value);
        if (pass_.block) outputs.push_back(*pass_.block);
        line("void main() {");
        ++depth_;
        line("beginTile();");
        if (pass_.is3D) {
            emitList(columnBoundary(graph_, outputs));
            line("for (int z = firstLayer(); z < lastLayer(); ++z) {");
            ++depth_;
        }
        emitList(outputs);
        for (const FieldOutput& f : pass_.fields) {
            const Type type = graph_.node(f.value).type;
            line(fmt::format("writeField({}u, {});", f.field, toBits(type, names_[f.value])));
        }
        if (pass_.is3D) {
            line(fmt::format("writeBlock(z, uint({}));", names_[*pass_.block]));
            --depth_;
            line("}");
        }
        --depth_;
        line("}");
        return std::move(text_);
    }

  private:
    void line(const std::string& content) {
        text_.append(static_cast<std::size_t>(4 * depth_), ' ');
        text_ += content;
        text_ += '\n';
    }

    void nameLeaves() {
        for (NodeId id = 0; id < graph_.size(); ++id) {
            const Node& n = graph_.node(id);
            if (n.op == Op::Constant) name(id, literal(n.type, n.imm));
            if (n.op == Op::PosX) name(id, "columnX");
            if (n.op == Op::PosY) name(id, "columnY");
            if (n.op == Op::PosZ) name(id, "z");
        }
    }

    void name(NodeId id, std::string text) {
        names_[id] = std::move(text);
        known_[id] = true;
    }

    void emitList(const std::vector<NodeId>& roots) {
        const std::vector<bool> inputs = known_;
        schedule_ = schedule(graph_, roots, [&](NodeId id) { return static_cast<bool>(inputs[id]); });
        emitRegion(0);
    }

    void emitRegion(int region) {
        const std::vector<NodeId>& nodes = schedule_.regions[static_cast<std::size_t>(region)].nodes;
        for (const NodeId id : nodes) {
            const Node& n = graph_.node(id);
            if (n.op != Op::Phi) {
                emitNode(id);
            } else if (schedule_.ifs[n.imm].phis.front() == id) {
                emitIf(schedule_.ifs[n.imm]);
            }
        }
    }

    void emitNode(NodeId id) {
        const Node& n = graph_.node(id);
        if (n.op == Op::Component) {
            static constexpr const char* kVoronoi[] = {".distance", ".ratio", ".offset.x", ".offset.y"};
            const NoiseKind kind = generator_.noises[graph_.node(n.args[0]).imm].kind;
            return name(id, names_[n.args[0]] + (kind == NoiseKind::Voronoi2D ? kVoronoi[n.imm] : ""));
        }
        name(id, fmt::format("v{}", id));
        if (n.op == Op::Noise) return emitNoise(names_[id], n.imm);
        line(fmt::format("{} {} = {};", typeName(n.type), names_[id], expression(n)));
    }

    std::string expression(const Node& n) const {
        switch (n.op) {
            case Op::Field:
                return fromBits(n.type, fmt::format("readField({}u)", n.imm));
            case Op::FieldAt:
                return fromBits(n.type, fmt::format("readFieldAt({}u, {}, {})", n.imm, arg(n, 0), arg(n, 1)));
            case Op::Random2D:
                return fmt::format("random2D({}, {}, randomSeeds[{}])", arg(n, 0), arg(n, 1), n.imm);
            case Op::Random3D:
                return fmt::format("random3D({}, {}, {}, randomSeeds[{}])", arg(n, 0), arg(n, 1), arg(n, 2),
                                   n.imm);
            default:
                break;
        }
        fmt::dynamic_format_arg_store<fmt::format_context> args;
        for (std::size_t k = 0; k < n.arguments().size(); ++k) args.push_back(arg(n, k));
        const std::string_view form = record(n.op).glsl;
        assert(!form.empty() && "every computing operation has a meaning in GLSL");
        return fmt::vformat(form, args);
    }

    const std::string& arg(const Node& n, std::size_t number) const { return names_[n.args[number]]; }

    void emitNoise(const std::string& result, std::uint32_t number) {
        const NoiseCall& call = generator_.noises[number];
        if (call.kind == NoiseKind::Voronoi2D) {
            line(fmt::format("Voronoi {} = voronoi2D(columnX, columnY, {}, {}u, noiseSeeds[{}]);", result,
                             call.size, call.maxPoints, number));
            return;
        }
        const bool is3D = call.kind == NoiseKind::Perlin3D;
        const char* function = is3D ? "perlin3D(columnX, columnY, z" : "perlin2D(columnX, columnY";
        for (std::size_t o = 0; o < call.weights.size(); ++o) {
            const int size = call.size << o;
            const std::string sample =
                fmt::format("{}, {}, {}, noiseSeeds[{}] + {:#x}u) * {}", function, size,
                            literal(Type::Float, bitsOf(1.0f / static_cast<float>(size))), number,
                            octaveSeedStep(o), literal(Type::Float, bitsOf(call.weights[o])));
            line(o == 0 ? fmt::format("precise float {} = {};", result, sample)
                        : fmt::format("{} = {} + {};", result, result, sample));
        }
    }

    void emitIf(const Schedule::If& branch) {
        for (const NodeId phi : branch.phis) {
            line(fmt::format("{} v{};", typeName(graph_.node(phi).type), phi));
        }
        line(fmt::format("if ({}) {{", names_[graph_.node(branch.phis.front()).args[0]]));
        emitSide(branch.thenRegion, branch.phis, 1);
        line("} else {");
        emitSide(branch.elseRegion, branch.phis, 2);
        line("}");
        for (const NodeId phi : branch.phis) name(phi, fmt::format("v{}", phi));
    }

    void emitSide(int region, const std::vector<NodeId>& phis, std::size_t side) {
        ++depth_;
        emitRegion(region);
        for (const NodeId phi : phis)
            line(fmt::format("v{} = {};", phi, names_[graph_.node(phi).args[side]]));
        --depth_;
    }

    const GeneratorGraph& generator_;
    const PassGraph& pass_;
    const Graph& graph_;
    std::vector<std::string> names_;  // by node: variable or literal
    std::vector<bool> known_;
    Schedule schedule_;
    std::string text_;
    int depth_ = 0;
};

}  // namespace

std::string emitGlsl(const GeneratorGraph& generator, std::size_t pass) {
    return Emitter(generator, pass).run();
}

}  // namespace terrane::gen
