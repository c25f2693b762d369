#include "python/src/draw_image.h"

#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "python/src/open_world.h"
#include "terrane/base/result.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/render/frame/graphics_table.h"
#include "terrane/render/frame/renderer.h"
#include "terrane/store/overlay_store.h"
#include "terrane/view/camera_path.h"
#include "terrane/view/gpu_back_ends.h"
#include "terrane/view/world_view.h"

namespace terrane::python {
namespace {

// Reads the store of an opened world, and keeps the world open.
class SharedReader : public store::ReadableStore {
  public:
    explicit SharedReader(std::shared_ptr<volume::OpenedWorld> world) : world_(std::move(world)) {}
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

  private:
    std::shared_ptr<volume::OpenedWorld> world_;
};

base::Result<void> checkRequest(const ImageRequest& request) {
    const auto isWithin = [](auto value, auto low, auto high) { return value >= low && value <= high; };
    const auto refuse = [](const char* name, auto low, auto high) {
        return base::fail(base::ErrorCode::BadInput, "{}: expected {} to {}", name, low, high);
    };
    if (!isWithin(request.size.x, 1, kMaxImageSide) || !isWithin(request.size.y, 1, kMaxImageSide))
        return refuse("size", 1, kMaxImageSide);
    if (!isWithin(request.viewDistance, 1, kMaxViewDistance))
        return refuse("view_distance", 1, kMaxViewDistance);
    if (!isWithin(request.horizon, 0, kMaxHorizon)) return refuse("horizon", 0, kMaxHorizon);
    if (!isWithin(request.fieldOfView, 1.0f, 170.0f)) return refuse("field_of_view", 1, 170);
    if (!isWithin(request.timeDay, 0.0f, 1.0f)) return refuse("time", 0, 1);
    if (!isWithin(request.pose.pitch, -90.0f, 90.0f)) return refuse("pitch", -90, 90);
    if (!std::isfinite(request.pose.yaw))
        return base::fail(base::ErrorCode::BadInput, "yaw: expected a finite number");
    constexpr double kEdge = 2147483648.0;
    const glm::dvec3& at = request.pose.position;
    if (!isWithin(at.x, -kEdge, kEdge - 1) || !isWithin(at.y, -kEdge, kEdge - 1) ||
        !isWithin(at.z, -1e6, 1e6))
        return base::fail(base::ErrorCode::BadInput, "position: outside the world");
    if (const std::string wrong = render::presetNameError(request.preset); !wrong.empty())
        return base::fail(base::ErrorCode::BadInput, "preset: {}", wrong);
    return {};
}

base::Result<game::SessionParts> partsOf(const DrawnWorld& world) {
    if (auto settled = world.opened->waitForTiles(); !settled) return tl::unexpected(settled.error());
    auto generators = generatorsOf(world.opened->store().identity(), world.content);
    if (!generators) return tl::unexpected(generators.error());
    return game::SessionParts{
        world.content.blocks, std::move(*generators),
        std::make_unique<store::OverlayStore>(std::make_unique<SharedReader>(world.opened)), world.threads,
        false};
}

// Called on the thread of the context.
base::Result<base::Image> drawInContext(game::SessionParts parts, const world::TextureSource& textures,
                                        const ImageRequest& request) {
    const auto context = gpu::HeadlessContext::create({});
    if (!context) return tl::unexpected(context.error());
    const gpu::ShaderLoader shaders = gpu::builtInShaders("");
    const gpu::DeviceInfo device = gpu::queryDevice();
    auto renderer = render::Renderer::create(shaders, *parts.blocks, textures, device);
    if (!renderer) return tl::unexpected(renderer.error());
    renderer->setMemoryBudget(view::gpuMemoryBudget(device, {}));
    const render::GraphicsSettings graphics =
        render::settingsOf({request.preset, {}, request.viewDistance}, device.software);
    if (auto done = renderer->configure(request.size, graphics.render); !done)
        return tl::unexpected(done.error());
    renderer->setViewDistance(request.viewDistance);
    game::Session session(std::move(parts));
    session.pipeline().setMeshOptions(graphics.mesh);
    view::WorldView view(session, *renderer);
    view.setHorizon({request.horizon, graphics.detail});
    const render::Camera camera = view::cameraOf(request.pose, request.fieldOfView);
    view::loadAll(session, view, camera, request.viewDistance, std::chrono::steady_clock::now());
    renderer->draw({camera, world::environmentAt(request.timeDay), view::fogDistance(view.visibleDistance()),
                    0, render::View::Color, game::waterAbove(session, camera.position)});
    return renderer->readImage();
}

}  // namespace

base::Result<base::Image> drawImage(const DrawnWorld& world, const ImageRequest& request) {
    if (auto checked = checkRequest(request); !checked) return tl::unexpected(checked.error());
    base::Result<base::Image> image = base::fail("not drawn");
    std::thread([&] {
        try {
            auto parts = partsOf(world);
            image = parts ? drawInContext(std::move(*parts), world.content.textures, request)
                          : tl::unexpected(parts.error());
        } catch (const std::exception& exception) {
            image = base::fail("render: {}", base::textOf(exception));
        }
    }).join();
    return image;
}

}  // namespace terrane::python
