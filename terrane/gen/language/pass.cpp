#include "terrane/gen/language/pass.h"

#include <algorithm>
#include <bit>

#include "terrane/gen/drainage/drainage_heights.h"
#include "terrane/gen/language/builder.h"

namespace terrane::gen {

Pass::Pass(GeneratorBuilder& generator, int number, std::string name, bool is3D)
    : generator_(generator), number_(number) {
    graph_.name = std::move(name);
    graph_.is3D = is3D;
    if (is3D) {
        const bool first = generator.last3DPass() < 0;
        blockSlot_ = newSlot(Type::Int, first ? Value(Block(world::kAir)) : Value(blockHere()));
        return;
    }
    fieldSlots_.resize(generator.generator_.fields.size());
    for (std::size_t k = 0; k < fieldSlots_.size(); ++k) {
        const FieldInfo& info = generator.generator_.fields[k];
        if (info.writtenBy < 0) fieldSlots_[k] = newSlot(info.type, Value{nullptr, 0});
    }
}

void Pass::error(std::string_view message) {
    auto& errors = generator_.errors_;
    std::string full = fmt::format("pass \"{}\": {}", graph_.name, message);
    // A mistake in an expression that is written several times counts once.
    if (std::find(errors.begin(), errors.end(), full) == errors.end()) errors.push_back(std::move(full));
}

bool Pass::require3D(std::string_view what) {
    if (!graph_.is3D) error(fmt::format("{}: only in 3D passes", what));
    return graph_.is3D;
}

Value Pass::leaf(Op op, Type type, std::uint32_t imm, std::uint8_t dependence) {
    return {&graph_.graph, graph_.graph.add(op, type, {}, imm, dependence)};
}

Int Pass::x() {
    return Int(leaf(Op::PosX, Type::Int, 0, kDependsColumn));
}
Int Pass::y() {
    return Int(leaf(Op::PosY, Type::Int, 0, kDependsColumn));
}
Int Pass::z() {
    if (!require3D("z")) return 0;
    return Int(leaf(Op::PosZ, Type::Int, 0, kDependsZ));
}

int Pass::step() const {
    return generator_.step();
}

world::Heights Pass::heights() const {
    return generator_.heights();
}

const std::vector<std::string>& Pass::mistakes() const {
    return generator_.mistakes();
}

Block Pass::block(std::string_view name) {
    if (name == "air") return Block(world::kAir);
    const world::BlockType* type = generator_.blocks_.find(name);
    if (!type) error(fmt::format("unknown block \"{}\"", name));
    return Block(type ? type->id : generator_.blocks_.missing());
}

std::size_t Pass::newSlot(Type type, Value value) {
    slots_.push_back({type, value.nodeIn(graph_.graph, type), false});
    return slots_.size() - 1;
}

void Pass::assign(std::size_t slot, Value value) {
    slots_[slot].value = value.nodeIn(graph_.graph, slots_[slot].type);
    slots_[slot].hasEnded = false;
}

// Runs both branches on the slots' values and joins the slots that came out different.
void Pass::if_(Bool condition, const std::function<void()>& then, const std::function<void()>& otherwise) {
    const NodeId conditionNode = condition.nodeIn(graph_.graph, Type::Bool);
    const std::vector<Slot> before = slots_;
    ++branchDepth_;
    if (then) then();
    const std::vector<Slot> afterThen = slots_;
    // Variables made in the first branch keep their slots, so that numbers of slots do not repeat; they are
    // not joined.
    for (std::size_t k = 0; k < before.size(); ++k) slots_[k] = before[k];
    if (otherwise) otherwise();
    --branchDepth_;

    const std::uint32_t number = graph_.graph.newIf();
    for (std::size_t k = 0; k < before.size(); ++k) {
        if (before[k].hasEnded) continue;
        const NodeId args[] = {conditionNode, afterThen[k].value, slots_[k].value};
        slots_[k].value = graph_.graph.add(Op::Phi, slots_[k].type, args, number);
    }
}

// Every variable may change in the loop; after it those that did have their last values, and those that were
// made in it have ended.
void Pass::while_(const std::function<Bool()>& condition, const std::function<void()>& body) {
    Graph& g = graph_.graph;
    const std::size_t count = slots_.size();
    const std::uint8_t dependence = graph_.is3D ? kDependsVoxel : kDependsColumn;
    struct Variable {
        std::size_t slot;
        std::uint32_t number;
    };
    std::vector<Variable> variables;
    g.beginLoop();
    for (std::size_t k = 0; k < count; ++k) {
        if (slots_[k].hasEnded) continue;
        variables.push_back({k, g.addLoopVariable(slots_[k].type, slots_[k].value, dependence)});
        slots_[k].value = g.loopVariable(variables.back().number).in;
    }
    ++branchDepth_;
    const NodeId conditionNode = condition().nodeIn(g, Type::Bool);
    body();
    --branchDepth_;
    std::vector<NodeId> next;
    for (const Variable& variable : variables) next.push_back(slots_[variable.slot].value);
    g.endLoop(conditionNode, next);
    for (const Variable& variable : variables) {
        const LoopVariable& v = g.loopVariable(variable.number);
        slots_[variable.slot].value = v.next == v.in ? v.initial : v.out;
    }
    for (std::size_t k = count; k < slots_.size(); ++k) slots_[k].hasEnded = true;
}

// False, with a message, where another pass writes the field.
bool Pass::claimField(std::uint32_t field) {
    FieldInfo& info = generator_.generator_.fields[field];
    if (info.writtenBy >= 0 && info.writtenBy != number_) {
        error(fmt::format("field \"{}\" is written by an earlier pass", info.name));
        return false;
    }
    info.writtenBy = number_;
    return true;
}

void Pass::setField(std::uint32_t field, Type type, Value value) {
    if (!requireField(field, type)) return;
    const FieldInfo& info = generator_.generator_.fields[field];
    if (graph_.is3D) return error(fmt::format("field \"{}\": 3D passes write fields with setAt", info.name));
    if (field >= fieldSlots_.size()) {
        return error(fmt::format("field \"{}\" is declared inside the pass that writes it", info.name));
    }
    if (claimField(field)) assign(*fieldSlots_[field], value);
}

void Pass::setFieldAt(std::uint32_t field, Type type, Int atZ, Value value) {
    if (!requireField(field, type) || !require3D("setAt")) return;
    const std::string name = generator_.generator_.fields[field].name;
    if (branchDepth_ > 0) return error(fmt::format("field \"{}\": setAt stands inside if_ or while_", name));
    if (generator_.generator_.fields[field].writtenBy == number_) {
        return error(fmt::format("field \"{}\" is set twice", name));
    }
    if (!claimField(field)) return;
    Graph& g = graph_.graph;
    const world::Heights heights = generator_.heights();
    const Int inWorld = clamp(atZ, heights.bottom, heights.top - 1);
    const NodeId isThere = (z() == inWorld).nodeIn(g, Type::Bool);
    const NodeId args[] = {isThere, value.nodeIn(g, type), g.constant(type, 0)};
    graph_.fields.push_back({field, g.add(Op::Phi, type, args, g.newIf()), isThere});
}

void Pass::setBlock(Block value) {
    if (!require3D("setBlock")) return;
    assign(*blockSlot_, value);
}

PassGraph Pass::finish() {
    for (std::size_t k = 0; k < fieldSlots_.size(); ++k) {
        const bool written = generator_.generator_.fields[k].writtenBy == number_;
        if (written) graph_.fields.push_back({static_cast<std::uint32_t>(k), slots_[*fieldSlots_[k]].value});
    }
    if (graph_.is3D) graph_.block = slots_[*blockSlot_].value;
    bool leaks = graph_.graph.leaksOutOfLoop();
    for (const NodeId output : outputsOf(graph_)) leaks = leaks || graph_.graph.node(output).loop != kNoLoop;
    if (leaks) error("a value made inside while_ is used after it: carry it out in a Var");
    if (graph_.graph.usesForeignValue())
        error("a value of another pass is used: write it to a field there and read it here");
    PassGraph done = std::move(graph_);
    graph_.graph = Graph();  // an expression that outlives the pass finds none of its nodes
    return done;
}

// Drainage maps while a generator is written: their declaration, and what a pass reads of them.

namespace {

bool isWithin(float v, float low, float high) {
    return v >= low && v <= high;
}

std::string mistakeIn(const DrainageSpec& s) {
    const auto spacing = static_cast<float>(s.spacing);
    if (s.spacing < 64 || s.spacing > 1024 || !std::has_single_bit(static_cast<unsigned>(s.spacing))) {
        return fmt::format("spacing {} is not a power of two in 64…1024", s.spacing);
    }
    // A node with so many steps of way above it has the next one do so too: rivers never end on land.
    if (s.minFlow < 1 || s.minFlow > kMaxUpstream) {
        return fmt::format("minFlow {} is not in 1…{}", s.minFlow, kMaxUpstream);
    }
    if (!isWithin(s.maxHalfWidth, 0.5f, 64.0f))
        return fmt::format("maxHalfWidth {} is not in 0.5…64", s.maxHalfWidth);
    if (!isWithin(s.halfWidth, 0.5f, s.maxHalfWidth)) {
        return fmt::format("halfWidth {} is not in 0.5…{}, its maximum", s.halfWidth, s.maxHalfWidth);
    }
    if (!isWithin(s.reach, 1.0f, spacing))
        return fmt::format("reach {} is not in 1…{}, the spacing", s.reach, s.spacing);
    if (!isWithin(s.bend, 0.0f, 0.25f)) return fmt::format("bend {} is not in 0…0.25", s.bend);
    constexpr int kLowest = world::kLowestBottom, kHighest = world::kHighestTop - 1;
    if (!isWithin(s.seaLevel, kLowest, kHighest))
        return fmt::format("seaLevel {} is not in {}…{}", s.seaLevel, kLowest, kHighest);
    if (!isWithin(s.lakeDepth, 0.0f, 1024.0f))
        return fmt::format("lakeDepth {} is not in 0…1024", s.lakeDepth);
    if (!isWithin(s.maxCut, 0.0f, 1024.0f)) return fmt::format("maxCut {} is not in 0…1024", s.maxCut);
    return "";
}

}  // namespace

Drainage GeneratorBuilder::drainage(const std::string& name, const DrainageSpec& spec,
                                    const std::function<Float(Pass&)>& height,
                                    const std::function<Float(Pass&)>& gradient) {
    DrainageGraph map{name, spec, {}, {}, {}};
    const auto error = [&](std::string_view message) {
        errors_.push_back(fmt::format("drainage \"{}\": {}", name, message));
    };
    if (const std::string mistake = mistakeIn(spec); !mistake.empty()) {
        error(mistake);
        map.spec = {};
    }
    auto& maps = generator_.drainages;
    if (std::any_of(maps.begin(), maps.end(), [&](const DrainageGraph& m) { return m.name == name; })) {
        error("declared twice");
    }
    // A builder of its own, of the level at which a column is a sample. It knows the fields of this one, so
    // that using them is a mistake with a name.
    GeneratorBuilder heights(name, blocks_, {drainageLevel(map.spec), generator_.heights});
    heights.noiseParameters_ = noiseParameters_;
    for (const FieldInfo& info : generator_.fields)
        heights.generator_.fields.push_back({info.name, info.type});
    const Field<Float> result = heights.field<Float>("height of drainage " + name);
    std::optional<Field<Float>> gradients;
    if (gradient) gradients = heights.field<Float>("gradient of drainage " + name);
    heights.pass2D("heights", [&](Pass& p) {
        p.set(result, height(p));
        if (gradients) p.set(*gradients, gradient(p));
    });
    for (const std::string& message : heights.errors_) error(message);
    noiseParameters_ = std::move(heights.noiseParameters_);
    map.heights = std::move(heights.generator_.passes.front());
    if (map.heights.fields.size() != (gradient ? 2 : 1)) error("its heights write a field");
    for (auto& pass : heights.written_) written_.push_back(std::move(pass));
    map.noises = std::move(heights.generator_.noises);
    map.hashNames = std::move(heights.generator_.hashNames);
    maps.push_back(std::move(map));
    return {static_cast<std::uint32_t>(maps.size() - 1)};
}

const DrainageGraph* Pass::drainageMap(Drainage map) {
    const auto& maps = generator_.generator_.drainages;
    if (map.index >= maps.size()) {
        error("drainage: this generator has no such map");
        return nullptr;
    }
    if (graph_.is3D) {
        error(fmt::format("drainage \"{}\": only in 2D passes", maps[map.index].name));
        return nullptr;
    }
    return &maps[map.index];
}

DrainageSample Pass::drainage(Drainage map) {
    const DrainageGraph* graph = drainageMap(map);
    if (graph == nullptr || step() > kMaxDrainageStep)
        return {kNoRiver, 0.0f, 0.0f, 0.0f, kNoRiver, 0.0f, 0.0f};
    const NoiseCall call = {NoiseKind::Drainage, graph->name, static_cast<std::int32_t>(map.index), {}};
    const auto result = [&](std::uint32_t k) { return Float(noise(call, k, Type::Float)); };
    return {result(0), result(1), result(2), result(3), result(4), result(5), result(6)};
}

ValleySample Pass::valleys(Drainage map) {
    const DrainageGraph* graph = drainageMap(map);
    if (graph != nullptr && !graph->hasValleys())
        error(fmt::format("drainage \"{}\": has no gradients, so no valleys", graph->name));
    if (graph == nullptr || !graph->hasValleys() || step() > kMaxValleyStep) return {kNoRiver, 0.0f, 0.0f};
    const NoiseCall call = {
        NoiseKind::Valleys, "valleys of " + graph->name, static_cast<std::int32_t>(map.index), {}};
    const auto result = [&](std::uint32_t k) { return Float(noise(call, k, Type::Float)); };
    return {result(0), result(1), result(2)};
}

// Random numbers that stand for what columns of higher levels are too wide to show.

namespace {

// The sum of two bytes of a hash, whose variance is 2 (256² − 1) / 12, as a number of mean 0 and deviation 1.
Float spread(Int hash, int shift) {
    constexpr float kDeviation = 104.51f;
    const Int sum = ((hash >> shift) & 0xFF) + ((hash >> (shift + 8)) & 0xFF);
    return Float(sum - 255) * (1.0f / kDeviation);
}

std::string grainSeedName(std::string_view name) {
    return "grain " + std::string(name);
}

}  // namespace

Vec2 Pass::grain2D(std::string_view name) {
    const Int position[] = {x(), y()};
    const Int bits = hash(grainSeedName(name), 0, position);
    return {spread(bits, 0), spread(bits, 16)};
}

Float Pass::grain(std::string_view name) {
    const Vec2 both = grain2D(name);
    constexpr float kRootOfHalf = 0.70710678f;
    return (both.x + both.y) * kRootOfHalf;
}

Float Pass::perlin2DWithGrain(std::string_view name, int size, std::vector<float> weights) {
    const float lost = lostDeviation(weights, size, step());
    const Float noise = perlin2D(name, size, std::move(weights));
    return lost == 0.0f ? noise : noise + grain(name) * lost;
}

// Reads of a pass: fields and blocks of earlier passes, in this column and around it.

// A field of another generator may have a number beyond those of this one, or that of a field of another
// type.
bool Pass::requireField(std::uint32_t field, Type type) {
    const auto& fields = generator_.generator_.fields;
    const bool isThere = field < fields.size();
    if (!isThere) {
        error("this generator has no such field");
    } else if (fields[field].type != type) {
        error(fmt::format("field \"{}\" holds values of another type", fields[field].name));
    }
    return isThere && fields[field].type == type;
}

bool Pass::requireWritten(std::uint32_t field, Type type) {
    if (!requireField(field, type)) return false;
    const FieldInfo& info = generator_.generator_.fields[field];
    const bool earlier = info.writtenBy >= 0 && info.writtenBy < number_;
    if (!earlier) error(fmt::format("field \"{}\" is read, but no earlier pass writes it", info.name));
    return earlier;
}

bool Pass::requireBlocks() {
    const bool earlier = generator_.last3DPass() >= 0;
    if (!earlier) error("blocks are read, but no earlier 3D pass sets them");
    return earlier;
}

Value Pass::readField(std::uint32_t field, Type type) {
    requireWritten(field, type);
    return leaf(Op::Field, type, field, kDependsColumn);
}

void Pass::checkOffset(std::string_view what, IVec2 offset) {
    for (const Int& o : {offset.x, offset.y}) {
        const bool isLiteral = o.graph == nullptr;
        if (isLiteral && (asInt(o.bits) < -kMaxReadOffset || asInt(o.bits) > kMaxReadOffset)) {
            error(fmt::format("{}: offset {} is beyond {} blocks", what, asInt(o.bits), kMaxReadOffset));
        }
    }
}

Value Pass::readFieldAt(std::uint32_t field, Type type, IVec2 offset) {
    requireWritten(field, type);
    if (!requireField(field, type)) return {nullptr, 0};
    checkOffset(fmt::format("field \"{}\"", generator_.generator_.fields[field].name), offset);
    return readColumn(field, type, nearestColumn(offset));
}

Value Pass::readColumn(std::uint32_t field, Type type, IVec2 columns) {
    auto& readsAt = graph_.readsAt;
    if (std::find(readsAt.begin(), readsAt.end(), field) == readsAt.end()) readsAt.push_back(field);
    Graph& g = graph_.graph;
    const NodeId args[] = {columns.x.nodeIn(g, Type::Int), columns.y.nodeIn(g, Type::Int)};
    return {&g, g.add(Op::FieldAt, type, args, field, kDependsColumn)};
}

// Clamps in blocks before it divides: executors clamp columns.
IVec2 Pass::nearestColumn(IVec2 offset) const {
    const int level = generator_.generator_.level, half = step() / 2;
    if (level == 0) return offset;
    const auto nearest = [&](Int blocks) {
        return (clamp(blocks, -kMaxReadOffset, kMaxReadOffset) + half) >> level;
    };
    return {nearest(offset.x), nearest(offset.y)};
}

Vec2 Pass::slope(Field<Float> field) {
    requireWritten(field.index, Type::Float);
    const int reach = slopeReach(step()) / step();  // columns
    const auto at = [&](int dx, int dy) { return Float(readColumn(field.index, Type::Float, {dx, dy})); };
    const float perBlock = 1.0f / static_cast<float>(2 * reach * step());
    return {(at(reach, 0) - at(-reach, 0)) * perBlock, (at(0, reach) - at(0, -reach)) * perBlock};
}

Float Pass::lowestBeside(Field<Float> field) {
    requireWritten(field.index, Type::Float);
    const auto at = [&](int dx, int dy) { return Float(readColumn(field.index, Type::Float, {dx, dy})); };
    return min(min(at(1, 0), at(-1, 0)), min(at(0, 1), at(0, -1)));
}

Float Pass::readBetween(Field<Float> field, Vec2 offset) {
    requireWritten(field.index, Type::Float);
    if (step() > 1) offset = offset * (1.0f / static_cast<float>(step()));
    const auto at = [&](Int dx, Int dy) { return Float(readColumn(field.index, Type::Float, {dx, dy})); };
    const Int x(floor(offset.x)), y(floor(offset.y));
    const Float fx = offset.x - floor(offset.x), fy = offset.y - floor(offset.y);
    const Float low = lerp(at(x, y), at(x + 1, y), fx), high = lerp(at(x, y + 1), at(x + 1, y + 1), fx);
    return lerp(low, high, fy);
}

Block Pass::blockHere() {
    if (!require3D("blockHere")) return Block(world::kAir);
    requireBlocks();
    return Block(leaf(Op::BlockHere, Type::Int, 0, kDependsVoxel));
}

Block Pass::blockInColumn(Int pz) {
    if (!requireBlocks()) return Block(world::kAir);
    Graph& g = graph_.graph;
    const NodeId args[] = {pz.nodeIn(g, Type::Int)};
    return Block(Value{&g, g.add(Op::BlockInColumn, Type::Int, args, 0, kDependsColumn)});
}

Block Pass::blockAt(IVec2 offset, Int pz) {
    if (!requireBlocks()) return Block(world::kAir);
    checkOffset("blockAt", offset);
    graph_.readsBlocksAt = true;
    Graph& g = graph_.graph;
    const IVec2 columns = nearestColumn(offset);
    const NodeId args[] = {columns.x.nodeIn(g, Type::Int), columns.y.nodeIn(g, Type::Int),
                           pz.nodeIn(g, Type::Int)};
    return Block(Value{&g, g.add(Op::BlockAt, Type::Int, args, 0, kDependsColumn)});
}

// Stamps of a pass, and the table of shapes of a generator.

Block Pass::stamp(Field<Int> shape, Field<Int> base) {
    if (!require3D("stamp")) return Block(world::kAir);
    const bool isWritten = requireWritten(shape.index, Type::Int) && requireWritten(base.index, Type::Int);
    auto& stamps = graph_.stamps;
    const StampCall call = {shape.index, base.index};
    const auto known = std::find(stamps.begin(), stamps.end(), call);
    const auto number = static_cast<std::uint32_t>(known - stamps.begin());
    if (known == stamps.end()) {
        if (stamps.size() == shared::kMaxStampsInPass)
            error(fmt::format("stamps from more than {} pairs of fields", shared::kMaxStampsInPass));
        if (!isWritten || stamps.size() == shared::kMaxStampsInPass) return Block(world::kAir);
        stamps.push_back(call);
    }
    for (const std::uint32_t field : {shape.index, base.index}) {
        auto& readsAt = graph_.readsAt;
        if (std::find(readsAt.begin(), readsAt.end(), field) == readsAt.end()) readsAt.push_back(field);
    }
    return Block(leaf(Op::Stamp, Type::Int, number, kDependsVoxel));
}

int GeneratorBuilder::shape(const VoxelShape& shape) {
    const std::string mistake = shapeMistake(shape, blocks_);
    if (!mistake.empty()) errors_.push_back(fmt::format("shape \"{}\": {}", shape.name, mistake));
    if (shapes_.size() == kMaxShapes) errors_.push_back(fmt::format("more than {} shapes", kMaxShapes));
    shapes_.push_back(shape);
    return static_cast<int>(shapes_.size() - 1);
}

// Only for a generator without mistakes that stamps: at most levels nothing does.
void GeneratorBuilder::makeShapeTable() {
    constexpr std::size_t kMaxCellBytes = 15 << 20;  // storage buffers of 16 MiB are guaranteed
    const auto stamps = [](const PassGraph& pass) { return !pass.stamps.empty(); };
    if (std::none_of(generator_.passes.begin(), generator_.passes.end(), stamps)) return;
    auto table = std::make_shared<ShapeTable>();
    for (const VoxelShape& shape : shapes_) addShape(*table, shape, generator_.level, blocks_);
    if (shapeCellBytes(*table) > kMaxCellBytes) {
        errors_.push_back(fmt::format("its shapes take {} bytes, at most {} are possible",
                                      shapeCellBytes(*table), kMaxCellBytes));
    }
    if (shapePaletteSize(*table) >= shared::kShapePaletteWords) {
        errors_.push_back(fmt::format("its shapes have {} blocks, at most {} are possible",
                                      shapePaletteSize(*table), shared::kShapePaletteWords - 1));
    }
    generator_.shapes = std::move(table);
}

}  // namespace terrane::gen
