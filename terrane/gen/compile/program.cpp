#include "terrane/gen/compile/program.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <unordered_map>

#include "terrane/gen/compile/schedule.h"

namespace terrane::gen {
namespace {

constexpr std::uint32_t kNeverFreed = std::numeric_limits<std::uint32_t>::max();

// Rows of the arena that come free are used again, by size: one row or a whole tile.
class RowAllocator {
  public:
    explicit RowAllocator(std::uint32_t first = 0) : next_(first) {}

    Operand allocate(bool varies, std::uint32_t results = 1) {
        auto& free = varies ? freeTiles_ : freeRows_;
        const std::uint32_t rows = varies ? kTileSize * results : 1;
        std::uint32_t row = next_;
        if (results == 1 && !free.empty()) {
            row = free.back();
            free.pop_back();
        } else {
            next_ += rows;  // beyond kMaxArenaRows operands are wrong; the program is never run then
        }
        return {static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(varies ? 1 : 0)};
    }
    void release(Operand o) { (o.rowStep ? freeTiles_ : freeRows_).push_back(o.row); }
    std::uint32_t rows() const { return next_; }
    // Rows allocated from here on are never shared with earlier values.
    void seal() {
        freeTiles_.clear();
        freeRows_.clear();
    }

  private:
    std::uint32_t next_;
    std::vector<std::uint32_t> freeTiles_, freeRows_;
};

class Compiler {
  public:
    Compiler(const PassGraph& pass, const std::vector<NoiseCall>& noises)
        : pass_(pass), graph_(pass.graph), noises_(noises), operands_(graph_.size()), known_(graph_.size()) {}

    Program run() {
        placeLeaves();
        return compileLists();
    }

    Program runAfter(const Program& base, std::vector<RowConstant>& constants) {
        rows_ = RowAllocator(base.layerRows);
        placeLeavesAfter(base, constants);
        return compileLists();
    }

  private:
    Program compileLists() {
        program_.is3D = pass_.is3D;
        program_.readsAt = pass_.readsAt;
        for (const std::uint32_t field : pass_.readsAt) program_.rowsAround.push_back(rowsAround(field));
        program_.readsBlocksAt = pass_.readsBlocksAt;
        program_.stamps = pass_.stamps;
        const std::vector<NodeId> outputs = outputsOf(pass_);
        if (pass_.is3D) {
            const std::vector<NodeId> boundary = columnBoundary(graph_, outputs);
            program_.column = compileList(boundary);
            for (const NodeId id : boundary) {
                if (graph_.node(id).op != Op::Constant) program_.inputs.push_back({id, operands_[id]});
            }
            rows_.seal();
            program_.layerRows = rows_.rows();
        }
        auto& last = pass_.is3D ? program_.layer : program_.column;
        last = compileList(outputs);
        for (const FieldOutput& f : pass_.fields) program_.fields.push_back({f.field, operands_[f.value]});
        if (pass_.block) program_.block = operands_[*pass_.block];
        program_.arenaRows = rows_.rows();
        return std::move(program_);
    }

    // Rows beyond the tile that the pass reads of a field. Stamps read all there are.
    int rowsAround(std::uint32_t field) const {
        for (const StampCall& call : pass_.stamps)
            if (call.shape == field || call.base == field) return kMaxReadOffset;
        int rows = 0;
        for (NodeId id = 0; id < graph_.size(); ++id) {
            const Node& n = graph_.node(id);
            if (n.op != Op::FieldAt || n.imm != field) continue;
            const Node& dy = graph_.node(n.args[1]);
            if (dy.op != Op::Constant) return kMaxReadOffset;
            rows = std::max(rows, std::abs(std::clamp(asInt(dy.imm), -kMaxReadOffset, kMaxReadOffset)));
        }
        return rows;
    }

    void placeLeaves() {
        for (NodeId id = 0; id < graph_.size(); ++id) {
            if (graph_.node(id).op != Op::Constant) continue;
            setOperand(id, rows_.allocate(false));
            program_.constants.push_back(graph_.node(id).imm);
        }
        program_.x = rows_.allocate(true);
        program_.y = rows_.allocate(true);
        program_.z = rows_.allocate(false);
        placePositions();
    }

    // Uses the rows of `base`, and rows of its own for constants that `base` lacks.
    void placeLeavesAfter(const Program& base, std::vector<RowConstant>& constants) {
        std::unordered_map<Bits, Operand> rowOf;
        for (std::size_t row = 0; row < base.constants.size(); ++row)
            rowOf.try_emplace(base.constants[row], Operand{static_cast<std::uint16_t>(row), 0});
        for (NodeId id = 0; id < graph_.size(); ++id) {
            if (graph_.node(id).op != Op::Constant) continue;
            const Bits value = graph_.node(id).imm;
            const auto [found, isNew] = rowOf.try_emplace(value);
            if (isNew) {
                found->second = rows_.allocate(false);
                constants.push_back({found->second, value});
            }
            setOperand(id, found->second);
        }
        program_.x = base.x;
        program_.y = base.y;
        program_.z = base.z;
        placePositions();
        for (const Program::Input& input : base.inputs) {
            if (!known_[input.node]) setOperand(input.node, input.value);
        }
    }

    void placePositions() {
        for (NodeId id = 0; id < graph_.size(); ++id) {
            const Op op = graph_.node(id).op;
            if (op == Op::PosX) setOperand(id, program_.x);
            if (op == Op::PosY) setOperand(id, program_.y);
            if (op == Op::PosZ) setOperand(id, program_.z);
        }
    }

    void setOperand(NodeId id, Operand o) {
        operands_[id] = o;
        known_[id] = true;
    }

    InstructionList compileList(const std::vector<NodeId>& roots) {
        const auto isInput = [&](NodeId id) { return static_cast<bool>(known_[id]); };
        schedule_ = schedule(graph_, roots, isInput);
        lastUse_.assign(graph_.size(), 0);
        inputs_ = known_;
        position_ = 0;
        findLastUses(0);
        for (const NodeId root : roots) lastUse_[root] = kNeverFreed;
        position_ = 0;
        return emitBasicBlock(0);
    }

    // Walks in the order of emission; a node's position is the count of nodes before it.
    void findLastUses(int basicBlock) {
        const std::vector<NodeId>& nodes = schedule_.basicBlocks[static_cast<std::size_t>(basicBlock)].nodes;
        for (const NodeId id : nodes) {
            const Op op = graph_.node(id).op;
            if (const Schedule::If* branch = schedule_.ifAt(graph_, id)) {
                findLastUses(branch->thenBlock);
                findLastUses(branch->elseBlock);
                for (const NodeId phi : branch->phis) noteUses(phi);
            } else if (const Schedule::Loop* loop = schedule_.loopAt(graph_, id)) {
                findLastUses(loop->head);
                findLastUses(loop->body);
                keepLoop(*loop);
            } else if (op != Op::Phi && op != Op::LoopIn && op != Op::LoopOut) {
                noteUses(id);
            }
        }
    }

    // Keeps the inputs of a loop, which every round reads.
    void keepLoop(const Schedule::Loop& loop) {
        for (const std::uint32_t v : loop.variables) {
            const LoopVariable& variable = graph_.loopVariable(v);
            for (const NodeId id : {variable.initial, variable.in, variable.next}) keep(id);
            keep(graph_.loops()[static_cast<std::size_t>(variable.loop)].condition);
        }
        for (const NodeId out : loop.outs) keep(out);
    }

    void keep(NodeId id) {
        lastUse_[id] = kNeverFreed;
        if (graph_.node(id).op == Op::Component) keep(graph_.node(id).args[0]);
    }

    void noteUses(NodeId id) {
        ++position_;
        for (const NodeId arg : graph_.node(id).arguments()) noteUse(arg, loopAround(id));
    }

    // A component has no register of its own: using it uses the noise.
    void noteUse(NodeId id, std::int32_t userLoop) {
        const bool isGivenToALoop = userLoop != kNoLoop && loopAround(id) != userLoop;
        if (isGivenToALoop) return keep(id);
        if (lastUse_[id] != kNeverFreed) lastUse_[id] = position_;
        if (graph_.node(id).op == Op::Component) noteUse(graph_.node(id).args[0], userLoop);
    }

    std::int32_t loopAround(NodeId id) const {
        const int basicBlock = schedule_.basicBlockOf[id];
        return basicBlock < 0 ? kNoLoop : schedule_.basicBlocks[static_cast<std::size_t>(basicBlock)].loop;
    }

    InstructionList emitBasicBlock(int basicBlock) {
        InstructionList list;
        const std::vector<NodeId>& nodes = schedule_.basicBlocks[static_cast<std::size_t>(basicBlock)].nodes;
        for (const NodeId id : nodes) {
            const Op op = graph_.node(id).op;
            if (const Schedule::If* branch = schedule_.ifAt(graph_, id)) {
                emitIf(*branch, list);
            } else if (const Schedule::Loop* loop = schedule_.loopAt(graph_, id)) {
                emitLoop(*loop, list);
            } else if (op != Op::Phi && op != Op::LoopIn && op != Op::LoopOut) {
                emitNode(id, list);
            }
        }
        return list;
    }

    void emitLoop(const Schedule::Loop& loop, InstructionList& list) {
        ProgramLoop result;
        for (const std::uint32_t v : loop.variables) {
            const LoopVariable& variable = graph_.loopVariable(v);
            setOperand(variable.in, rows_.allocate(true));
            setOperand(variable.out, operands_[variable.in]);
            result.variables.push_back({operands_[variable.in], operands_[variable.initial], {}, {}});
        }
        result.head = emitBasicBlock(loop.head);
        const std::int32_t number = graph_.loopVariable(loop.variables.front()).loop;
        result.condition = operands_[graph_.loops()[static_cast<std::size_t>(number)].condition];
        result.body = emitBasicBlock(loop.body);
        for (std::size_t k = 0; k < loop.variables.size(); ++k) {
            result.variables[k].next = operands_[graph_.loopVariable(loop.variables[k]).next];
            result.variables[k].changed = rows_.allocate(true);
        }
        for (const LoopMove& move : result.variables) rows_.release(move.changed);
        Instruction instruction;
        instruction.op = Op::LoopOut;
        instruction.imm = static_cast<std::uint32_t>(program_.loops.size());
        program_.loops.push_back(std::move(result));
        list.push_back(instruction);
    }

    void emitNode(NodeId id, InstructionList& list) {
        const Node& n = graph_.node(id);
        ++position_;
        if (n.op == Op::Component) return aliasResult(id);
        Instruction instruction;
        instruction.op = n.op;
        instruction.imm = n.imm;
        readArguments(id, instruction);
        std::uint32_t results = 1;
        if (makesNoise(n.op)) results = resultCount(noises_[n.imm].kind);
        setOperand(id, rows_.allocate(varies(id), results));
        instruction.dst = operands_[id];
        list.push_back(instruction);
    }

    void aliasResult(NodeId id) {
        const Node& n = graph_.node(id);
        Operand o = operands_[n.args[0]];
        o.row = static_cast<std::uint16_t>(o.row + n.imm * kTileSize);
        setOperand(id, o);
        // The rows belong to the noise; they are kept for good, since results may outlive each other.
        lastUse_[id] = kNeverFreed;
        lastUse_[n.args[0]] = kNeverFreed;
    }

    void readArguments(NodeId id, Instruction& instruction) {
        const auto args = graph_.node(id).arguments();
        for (std::size_t k = 0; k < args.size(); ++k) instruction.args[k] = operands_[args[k]];
        releaseArguments(id);
    }

    void releaseArguments(NodeId id) {
        for (const NodeId arg : graph_.node(id).arguments()) {
            if (lastUse_[arg] != position_ || inputs_[arg]) continue;
            rows_.release(operands_[arg]);
            lastUse_[arg] = kNeverFreed;  // an argument may stand twice
        }
    }

    void emitIf(const Schedule::If& branch, InstructionList& list) {
        Branch result;
        result.condition = operands_[graph_.node(branch.phis.front()).args[0]];
        result.then = emitBasicBlock(branch.thenBlock);
        result.otherwise = emitBasicBlock(branch.elseBlock);
        const bool noBranch = result.then.empty() && result.otherwise.empty();
        for (const NodeId phi : branch.phis) {
            ++position_;
            Instruction choice;
            choice.op = Op::Select;
            readArguments(phi, choice);
            setOperand(phi, rows_.allocate(varies(phi)));
            choice.dst = operands_[phi];
            if (noBranch) list.push_back(choice);
            result.phis.push_back({choice.dst, choice.args[1], choice.args[2]});
        }
        if (noBranch) return;
        Instruction instruction;
        instruction.op = Op::Phi;
        instruction.imm = static_cast<std::uint32_t>(program_.branches.size());
        program_.branches.push_back(std::move(result));
        list.push_back(instruction);
    }

    bool varies(NodeId id) const { return (graph_.node(id).dependence & kDependsColumn) != 0; }

    const PassGraph& pass_;
    const Graph& graph_;
    const std::vector<NoiseCall>& noises_;
    std::vector<Operand> operands_;  // by node
    std::vector<bool> known_;        // has an operand
    std::vector<bool> inputs_;       // had one before this list
    std::vector<std::uint32_t> lastUse_;
    std::uint32_t position_ = 0;
    Schedule schedule_;
    RowAllocator rows_;
    Program program_;
};

}  // namespace

Program compile(const PassGraph& pass, const std::vector<NoiseCall>& noises) {
    return Compiler(pass, noises).run();
}

Program compileAfter(const Program& base, const PassGraph& pass, const std::vector<NoiseCall>& noises,
                     std::vector<RowConstant>& constants) {
    return Compiler(pass, noises).runAfter(base, constants);
}

}  // namespace terrane::gen
