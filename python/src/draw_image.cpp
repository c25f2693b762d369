#include "python/src/draw_image.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <system_error>
#include <unordered_set>
#include <utility>
#include <vector>

#include "python/src/open_world.h"
#include "terrane/base/result.h"
#include "terrane/render/frame/graphics_table.h"
#include "terrane/store/overlay_store.h"
#include "terrane/view/camera_path.h"
#include "terrane/view/offscreen.h"

namespace terrane::python {
namespace {

using Clock = std::chrono::steady_clock;

// Reads the store of an opened world, and keeps the world open. A session that only draws changes no block of
// its own: nothing is saved.
class DrawnStore : public store::ChunkStore {
  public:
    explicit DrawnStore(std::shared_ptr<volume::OpenedWorld> world) : world_(std::move(world)) {}
    store::LoadedChunk load(world::ChunkPos pos) override { return world_->store().load(pos); }
    std::vector<store::LoadedChunk> loadMany(std::span<const world::ChunkPos> positions) override {
        return world_->store().loadMany(positions);
    }
    bool contains(world::ChunkPos pos) override { return world_->store().contains(pos); }
    base::Result<std::vector<world::ChunkPos>> editedChunks() override {
        return world_->store().editedChunks();
    }
    std::optional<std::string> metadata(std::string_view name) override {
        return world_->store().metadata(name);
    }
    const store::WorldIdentity& identity() const override { return world_->store().identity(); }
    store::SaveNumber save(world::ChunkPos, world::ChunkPtr, store::Provenance) override { return 0; }
    store::SaveNumber setMetadata(std::string_view, std::string) override { return 0; }
    base::Result<void> flush() override { return {}; }
    store::SaveStatus status() override { return {}; }
    void setDerivedRows(store::DerivedRows) override {}
    base::Result<void> deriveAll(std::string_view) override { return {}; }
    bool isPersistent() const override { return false; }

  private:
    std::shared_ptr<volume::OpenedWorld> world_;
};

// The chunks that edits changed since the last image.
class EditedChunks {
  public:
    // Beyond so many the scene is loaded anew.
    static constexpr std::size_t kMost = 4096;

    explicit EditedChunks(volume::OpenedWorld& world) : world_(world) {
        world_.setEditListener([this](std::span<const world::ChunkPos> chunks) {
            const std::lock_guard lock(mutex_);
            if (chunks_.size() <= kMost) chunks_.insert(chunks.begin(), chunks.end());
        });
    }
    ~EditedChunks() { world_.setEditListener({}); }
    EditedChunks(const EditedChunks&) = delete;
    EditedChunks& operator=(const EditedChunks&) = delete;

    base::Result<base::Image> drawParts(game::SessionParts parts, const pack::Content& content,
                                        const ImageRequest& request) {
        const auto world = view::Offscreen::create(
            std::move(parts), content.generators, content.textures,
            {.size = request.size, .graphics = {request.preset, {}, request.viewDistance}});
        if (!world) return tl::unexpected(world.error());
        game::Session& session = *(*world)->session;
        view::WorldView& view = *(*world)->view;
        view.setHorizon({request.horizon, (*world)->graphics.detail});
        const render::Camera camera = view::cameraOf(request.pose, request.fieldOfView);
        view::loadAll(session, view, camera, request.viewDistance, std::chrono::steady_clock::now());
        render::Renderer& renderer = (*world)->renderer;
        renderer.draw({camera, world::environmentAt(request.timeDay),
                       view::fogDistance(view.visibleDistance()), 0, render::View::Color,
                       game::waterAbove(session, camera.position)});
        return renderer.readImage();
    }

}  // namespace

base::Result<base::Image>
drawImage(const DrawnWorld& world, const ImageRequest& request) {
    if (auto checked = checkRequest(request); !checked) return tl::unexpected(checked.error());
    base::Result<base::Image> image = base::fail("not drawn");
    std::thread([&] {
        try {
            auto parts = partsOf(world);
            image =
                parts ? drawParts(std::move(*parts), world.content, request) : tl::unexpected(parts.error());
        } catch (const std::exception& exception) {
            image = base::fail("render: {}", base::textOf(exception));
        }
    }).join();
    return image;
}

}  // namespace terrane::python
