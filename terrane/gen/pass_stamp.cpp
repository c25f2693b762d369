// Stamps of a pass, and the table of shapes of a generator.
#include <algorithm>

#include "terrane/gen/builder.h"
#include "terrane/gen/pass.h"

namespace terrane::gen {

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
