#include "terrane/store/chunks/block_id_map.h"

namespace terrane::store {
namespace {

constexpr std::size_t kMaxIds = 65536;

}  // namespace

base::Result<BlockIdMap> BlockIdMap::make(const world::BlockRegistry& registry,
                                          const std::vector<SavedName>& saved) {
    BlockIdMap map;
    map.names_ = saved;
    map.toSaved_.assign(registry.types().size(), kNone);
    map.toSession_.assign(kMaxIds, kNone);
    const auto connect = [&](world::BlockId savedId, std::size_t session) {
        map.toSession_[savedId] = static_cast<std::uint32_t>(session);
        map.toSaved_[session] = savedId;
    };

    for (const SavedName& entry : saved) {
        if (map.toSession_[entry.id] != kNone)
            return base::fail(base::ErrorCode::Damaged, "block id {} stands for two block types", entry.id);
        if (const world::BlockType* type = registry.find(entry.name)) {
            connect(entry.id, type->id);
            continue;
        }
        map.unknown_.push_back(entry.name);
        map.toSaved_.push_back(kNone);
        if (map.toSaved_.size() > kMaxIds)
            return base::fail(base::ErrorCode::Incompatible, "more than {} block types", kMaxIds);
        connect(entry.id, map.toSaved_.size() - 1);
    }

    std::size_t next = 0;
    for (const world::BlockType& type : registry.types()) {
        if (map.toSaved_[type.id] != kNone) continue;
        while (next < kMaxIds && map.toSession_[next] != kNone) ++next;
        if (next == kMaxIds)
            return base::fail(base::ErrorCode::Incompatible, "more than {} block types", kMaxIds);
        const auto id = static_cast<world::BlockId>(next);
        connect(id, type.id);
        map.added_.push_back({id, type.name});
    }
    map.names_.insert(map.names_.end(), map.added_.begin(), map.added_.end());
    return map;
}

}  // namespace terrane::store
