#include "terrane/gen/compile/glsl_emitter.h"

#include <fmt/args.h>
#include <fmt/format.h>

#include <cassert>

#include "terrane/gen/compile/schedule.h"

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

// Convert a field's 32 bits to a value of its type, and back.
std::string fromBits(Type type, const std::string& bits) {
    if (type == Type::Bool) return bits + " != 0u";
    return type == Type::Float ? "uintBitsToFloat(" + bits + ")" : "int(" + bits + ")";
}

std::string toBits(Type type, const std::string& value) {
    if (type == Type::Bool) return value + " ? ~0u : 0u";
    return type == Type::Float ? "floatBitsToUint(" + value + ")" : "uint(" + value + ")";
}

std::string_view componentName(NoiseKind kind, std::uint32_t number) {
    static constexpr std::string_view kVoronoi2D[] = {".distance", ".ratio", ".offset.x", ".offset.y"};
    static constexpr std::string_view kVoronoi3D[] = {".nearest", ".second", ".offset.x", ".offset.y",
                                                      ".offset.z"};
    static constexpr std::string_view kStripes2D[] = {".x", ".y"};
    static constexpr std::string_view kDrainage[] = {".distance",     ".halfWidth", ".level", ".flow",
                                                     ".lakeDistance", ".lakeLevel", ".fall"};
    static constexpr std::string_view kValleys[] = {".distance", ".level", ".flow"};
    if (kind == NoiseKind::Drainage) return kDrainage[number];
    if (kind == NoiseKind::Valleys) return kValleys[number];
    if (kind == NoiseKind::Voronoi2D) return kVoronoi2D[number];
    if (kind == NoiseKind::Stripes2D) return kStripes2D[number];
    return kind == NoiseKind::Voronoi3D ? kVoronoi3D[number] : "";
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
        const std::vector<NodeId> outputs = outputsOf(pass_);
        line("void main() {");
        ++depth_;
        line("beginTile();");
        emitStamps();
        if (pass_.is3D) {
            emitList(columnBoundary(graph_, outputs));
            line("for (int z = firstLayer(); z < lastLayer(); ++z) {");
            ++depth_;
        }
        emitList(outputs);
        for (const FieldOutput& f : pass_.fields) {
            const Type type = graph_.node(f.value).type;
            const std::string condition = f.isWritten ? fmt::format("if ({}) ", names_[*f.isWritten]) : "";
            line(fmt::format("{}writeField({}u, {});", condition, f.field, toBits(type, names_[f.value])));
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

    void emitStamps() {
        if (pass_.stamps.empty()) return;
        line("beginStamps();");
        for (std::size_t k = 0; k < pass_.stamps.size(); ++k) {
            line(fmt::format("findFeet({}u, {}u, {}u);", k, pass_.stamps[k].shape, pass_.stamps[k].base));
        }
        line("endStamps();");
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
        emitBasicBlock(0);
    }

    void emitBasicBlock(int basicBlock) {
        const std::vector<NodeId>& nodes = schedule_.basicBlocks[static_cast<std::size_t>(basicBlock)].nodes;
        for (const NodeId id : nodes) {
            const Op op = graph_.node(id).op;
            if (const Schedule::If* branch = schedule_.ifAt(graph_, id)) {
                emitIf(*branch);
            } else if (const Schedule::Loop* loop = schedule_.loopAt(graph_, id)) {
                emitLoop(*loop);
            } else if (op != Op::Phi && op != Op::LoopIn && op != Op::LoopOut) {
                emitNode(id);
            }
        }
    }

    void emitNode(NodeId id) {
        const Node& n = graph_.node(id);
        if (n.op == Op::Component) {
            const NoiseKind kind = generator_.noises[graph_.node(n.args[0]).imm].kind;
            return name(id, names_[n.args[0]] + std::string(componentName(kind, n.imm)));
        }
        name(id, fmt::format("v{}", id));
        if (n.op == Op::Noise) return emitNoise(names_[id], n.imm);
        if (n.op == Op::Stripes) return emitStripes(id);
        line(fmt::format("{} {} = {};", typeName(n.type), names_[id], expression(n)));
    }

    std::string expression(const Node& n) const {
        switch (n.op) {
            case Op::Field:
                return fromBits(n.type, fmt::format("readField({}u)", n.imm));
            case Op::FieldAt:
                return fromBits(n.type, fmt::format("readFieldAt({}u, {}, {})", n.imm, arg(n, 0), arg(n, 1)));
            case Op::Stamp:
                return fmt::format("stampAt({}u, z)", n.imm);
            case Op::Hash2:
                return fmt::format("int(hash2(uint({}), uint({}), {}))", arg(n, 0), arg(n, 1),
                                   hashSeed(n.imm));
            case Op::Hash3:
                return fmt::format("int(hash3(uint({}), uint({}), uint({}), {}))", arg(n, 0), arg(n, 1),
                                   arg(n, 2), hashSeed(n.imm));
            default:
                break;
        }
        fmt::dynamic_format_arg_store<fmt::format_context> args;
        for (std::size_t k = 0; k < n.arguments().size(); ++k) args.push_back(arg(n, k));
        const std::string_view form = record(n.op).glsl;
        assert(!form.empty() && "every computing operation has a meaning in GLSL");
        return fmt::vformat(form, args);
    }

    static std::string hashSeed(std::uint32_t packed) {
        return fmt::format("hashSeeds[{}] + {:#x}u", hashSlot(packed), octaveSeedStep(hashOctave(packed)));
    }

    const std::string& arg(const Node& n, std::size_t number) const { return names_[n.args[number]]; }

    void emitNoise(const std::string& result, std::uint32_t number) {
        const NoiseCall& call = generator_.noises[number];
        if (readsDrainage(call.kind)) {
            const DrainageSpec& spec = generator_.drainages[static_cast<std::size_t>(call.size)].spec;
            const bool isValleys = call.kind == NoiseKind::Valleys;
            const float reach = isValleys ? valleyReach(spec) : spec.reach;
            return line(fmt::format("{} {} = {}({}u, {}u, {});", isValleys ? "Valleys" : "Drainage", result,
                                    isValleys ? "valleys" : "drainage", call.size,
                                    generator_.drainages.size(), literal(Type::Float, bitsOf(reach))));
        }
        if (call.kind == NoiseKind::Voronoi2D) {
            return line(fmt::format("Voronoi {} = voronoi2D(columnX, columnY, {}, {}u, noiseSeeds[{}]);",
                                    result, call.size, call.maxPoints, number));
        }
        if (call.kind == NoiseKind::Voronoi3D) {
            const Bits inverseSize = bitsOf(1.0f / static_cast<float>(call.size));
            return line(fmt::format(
                "Voronoi3 {} = voronoi3D(ivec3(columnX, columnY, z), {}, {}, {}u, {}, noiseSeeds[{}]);",
                result, call.size, literal(Type::Float, inverseSize), call.maxPoints, call.exponent, number));
        }
        emitOctaves(result, number);
    }

    void emitStripes(NodeId id) {
        const Node& n = graph_.node(id);
        const std::int32_t size = generator_.noises[n.imm].size;
        const Bits inverseSize = bitsOf(1.0f / static_cast<float>(size));
        line(fmt::format("precise vec2 {} = stripes2D(columnX, columnY, {}, {}, {}, {}, noiseSeeds[{}]);",
                         names_[id], arg(n, 0), arg(n, 1), size, literal(Type::Float, inverseSize), n.imm));
    }

    static const char* octaveFunction(NoiseKind kind) {
        if (kind == NoiseKind::Perlin3D) return "perlin3D(columnX, columnY, z";
        return kind == NoiseKind::Simplex2D ? "simplex2D(columnX, columnY" : "perlin2D(columnX, columnY";
    }

    void emitOctaves(const std::string& result, std::uint32_t number) {
        const NoiseCall& call = generator_.noises[number];
        const char* function = octaveFunction(call.kind);
        bool isFirst = true;
        for (const Octave& o : octavesOf(call)) {
            const std::string sample =
                fmt::format("{}, {}, {}, noiseSeeds[{}] + {:#x}u) * {}", function, o.size,
                            literal(Type::Float, bitsOf(1.0f / static_cast<float>(o.size))), number,
                            o.seedStep, literal(Type::Float, bitsOf(o.weight)));
            line(isFirst ? fmt::format("precise float {} = {};", result, sample)
                         : fmt::format("{} = {} + {};", result, result, sample));
            isFirst = false;
        }
    }

    void emitIf(const Schedule::If& branch) {
        for (const NodeId phi : branch.phis) {
            line(fmt::format("{} v{};", typeName(graph_.node(phi).type), phi));
        }
        line(fmt::format("if ({}) {{", names_[graph_.node(branch.phis.front()).args[0]]));
        emitSide(branch.thenBlock, branch.phis, 1);
        line("} else {");
        emitSide(branch.elseBlock, branch.phis, 2);
        line("}");
        for (const NodeId phi : branch.phis) name(phi, fmt::format("v{}", phi));
    }

    void emitSide(int basicBlock, const std::vector<NodeId>& phis, std::size_t side) {
        ++depth_;
        emitBasicBlock(basicBlock);
        for (const NodeId phi : phis)
            line(fmt::format("v{} = {};", phi, names_[graph_.node(phi).args[side]]));
        --depth_;
    }

    void emitLoop(const Schedule::Loop& loop) {
        for (const std::uint32_t v : loop.variables) {
            const LoopVariable& variable = graph_.loopVariable(v);
            name(variable.in, fmt::format("v{}", variable.in));
            name(variable.out, names_[variable.in]);
            line(fmt::format("{} {} = {};", typeName(graph_.node(variable.in).type), names_[variable.in],
                             names_[variable.initial]));
        }
        const std::int32_t number = graph_.loopVariable(loop.variables.front()).loop;
        const NodeId condition = graph_.loops()[static_cast<std::size_t>(number)].condition;
        line(fmt::format("for (int round{0} = 0; round{0} < kMaxLoopRounds; ++round{0}) {{", number));
        ++depth_;
        emitBasicBlock(loop.head);
        line(fmt::format("if (!({})) break;", names_[condition]));
        emitBasicBlock(loop.body);
        // All change at once: a next value may be another variable's.
        for (const std::uint32_t v : loop.variables) {
            const LoopVariable& variable = graph_.loopVariable(v);
            line(fmt::format("{} next{} = {};", typeName(graph_.node(variable.in).type), v,
                             names_[variable.next]));
        }
        for (const std::uint32_t v : loop.variables) {
            line(fmt::format("{} = next{};", names_[graph_.loopVariable(v).in], v));
        }
        --depth_;
        line("}");
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
