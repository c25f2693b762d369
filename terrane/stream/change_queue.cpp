#include "terrane/stream/change_queue.h"

#include <utility>

namespace terrane::stream {

using world::ChunkPos;

ChunkChange& ChangeQueue::change(ChunkPos pos) {
    const auto [it, isNew] = changes_.try_emplace(pos);
    it->second.pos = pos;
    it->second.isHidden = false;
    if (isNew) others_.push_back(pos);
    return it->second;
}

void ChangeQueue::setLight(ChunkPos pos, light::ChunkLightPtr light, const world::SectionSet& bricks) {
    ChunkChange& changed = change(pos);
    changed.light = std::move(light);
    changed.bricks |= bricks;
}

void ChangeQueue::setLight(ChunkPos pos, light::ChunkLightPtr light) {
    const auto all = world::SectionSet::all(light->heights());
    setLight(pos, std::move(light), all);
}

void ChangeQueue::setMesh(ChunkPos pos, MeshPtr mesh, mesh::MeshSectionSet meshSections) {
    ChunkChange& changed = change(pos);
    if (changed.mesh && meshSections != mesh::kAllMeshSections) {
        mesh = std::make_shared<const mesh::ChunkMesh>(
            mesh::withMeshSections(*changed.mesh, *mesh, meshSections));
    }
    changed.mesh = std::move(mesh);
    changed.meshSections |= meshSections;
}

void ChangeQueue::requestMesh(ChunkPos pos) {
    ChunkChange& changed = change(pos);
    changed.mesh = nullptr;
    changed.meshSections = {};
    changed.needsMesh = true;
}

bool ChangeQueue::isMeshRequested(ChunkPos pos) const {
    const auto found = changes_.find(pos);
    return found != changes_.end() && found->second.needsMesh;
}

void ChangeQueue::hide(ChunkPos pos) {
    ChunkChange& changed = change(pos);
    changed = {};
    changed.pos = pos;
    changed.isHidden = true;
}

void ChangeQueue::prioritize(ChunkPos pos) {
    if (first_.empty() || first_.back() != pos) first_.push_back(pos);
}

std::vector<ChunkChange> ChangeQueue::take(std::size_t limit) {
    std::vector<ChunkChange> taken;
    for (std::deque<ChunkPos>* queue : {&first_, &others_}) {
        for (; taken.size() < limit && !queue->empty(); queue->pop_front()) {
            if (auto node = changes_.extract(queue->front())) taken.push_back(std::move(node.mapped()));
        }
    }
    return taken;
}

std::vector<ChunkPos> ChangeQueue::takeHidden() {
    std::vector<ChunkPos> hidden;
    std::erase_if(changes_, [&](const auto& entry) {
        if (entry.second.isHidden) hidden.push_back(entry.first);
        return entry.second.isHidden;
    });
    return hidden;
}

}  // namespace terrane::stream
