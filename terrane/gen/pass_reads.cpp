// Reads of a pass: fields and blocks of earlier passes, in this column and around it.
#include <algorithm>

#include "terrane/gen/builder.h"
#include "terrane/gen/pass.h"

namespace terrane::gen {

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

}  // namespace terrane::gen
