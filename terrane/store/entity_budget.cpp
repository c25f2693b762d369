#include "terrane/store/entity_budget.h"

#include <utility>

namespace terrane::store {
namespace {

// Around the data of one block: the vector, the count of its owners, the chunk's slot, the allocator's part.
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

}  // namespace terrane::store
