#include "terrane/store/chunks/entity_budget.h"

#include <utility>

namespace terrane::store {
namespace {

// Overhead per block: the vector, its reference count, the chunk's slot, the allocator.
constexpr std::size_t kOverheadBytes = 128;

}  // namespace

world::BlockEntityDataPtr EntityBudget::hold(world::BlockEntityData data) {
    const std::size_t bytes = data.capacity() + kOverheadBytes;
    if (used_->fetch_add(bytes) + bytes > maxBytes_) {
        *used_ -= bytes;
        return nullptr;
    }
    const auto release = [used = used_, bytes](const world::BlockEntityData* held) {
        delete held;
        *used -= bytes;
    };
    return {new world::BlockEntityData(std::move(data)), release};
}

tl::unexpected<base::Error> overBudget(const EntityBudget& budget) {
    return base::fail(base::ErrorCode::OutOfResources,
                      "its block entity data are more than may be in memory at once ({} bytes of all chunks)",
                      budget.maxBytes());
}

base::Result<world::BlockEntityDataPtr> holdData(ByteView bytes, EntityBudget* budget) {
    world::BlockEntityData data(bytes.begin(), bytes.end());
    if (!budget) return std::make_shared<const world::BlockEntityData>(std::move(data));
    auto held = budget->hold(std::move(data));
    if (!held) return overBudget(*budget);
    return held;
}

}  // namespace terrane::store
