#include "python/src/draw_image.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <system_error>
#include <unordered_set>
#include <utility>
#include <vector>

#include "python/src/open_world.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/render/frame/graphics_table.h"
#include "terrane/render/frame/renderer.h"
#include "terrane/render/quads/draw_check.h"
#include "terrane/view/camera_path.h"
#include "terrane/view/eye.h"
#include "terrane/view/gpu_back_ends.h"
#include "terrane/view/world_view.h"

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

    std::unordered_set<world::ChunkPos, world::ChunkPosHash> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(chunks_, {});
    }

  private:
    volume::OpenedWorld& world_;
    std::mutex mutex_;
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> chunks_;
};

// What does not depend on the chunks: kept for all images.
struct Canvas {
    gpu::HeadlessContext context;
    std::unique_ptr<gpu::ShaderLoader> shaders;
    gpu::DeviceInfo device;
    render::Renderer renderer;
};

base::Result<std::unique_ptr<Canvas>> makeCanvas(const DrawnWorld& world) {
    auto context = TERRANE_TRY(gpu::HeadlessContext::create({}));
    auto shaders = std::make_unique<gpu::ShaderLoader>(gpu::builtInShaders(""));
    const gpu::DeviceInfo device = render::checkedDevice(*shaders);
    auto renderer = TERRANE_TRY(
        render::Renderer::create(*shaders, *world.content.blocks, world.content.textures, device));
    renderer.setMemoryBudget(view::gpuMemoryBudget(device, {}));
    return std::make_unique<Canvas>(
        Canvas{std::move(context), std::move(shaders), device, std::move(renderer)});
}

// The chunks of the last image.
struct Scene {
    Scene(game::SessionParts parts, render::Renderer& renderer)
        : session(std::move(parts)), view(session, renderer) {}
    game::Session session;
    view::WorldView view;
    int viewDistance = 0;   // that the renderer has light for
    bool hasTiles = false;  // an image had a horizon
};

base::Result<std::unique_ptr<Scene>> makeScene(const DrawnWorld& world, Canvas& canvas) {
    canvas.renderer.clearChunks();
    auto generators = TERRANE_TRY(generatorsOf(world.opened->store().identity(), world.content));
    return std::make_unique<Scene>(
        game::SessionParts{world.content.blocks, std::move(generators),
                           std::make_unique<DrawnStore>(world.opened), world.threads, false},
        canvas.renderer);
}

world::BlockValue valueIn(const world::Chunk& chunk, world::BlockIndex at) {
    return {chunk.block(at), chunk.blockState(at), chunk.sharedBlockEntityData(at)};
}

// The blocks of the stored chunk that differ from those of the loaded one.
std::vector<world::PlacedBlock> differences(const world::Chunk& loaded, const world::Chunk& stored,
                                            world::ChunkPos pos) {
    const bool hasData =
        !loaded.blocksWithBlockEntityData().empty() || !stored.blocksWithBlockEntityData().empty();
    std::vector<world::PlacedBlock> blocks;
    for (int s = loaded.heights().firstSection(); s < loaded.heights().endSection(); ++s) {
        const bool isEqual =
            loaded.section(s) == stored.section(s) && loaded.blockStates(s) == stored.blockStates(s);
        if (isEqual && !hasData) continue;
        for (int k = 0; k < world::kBlocksPerSection; ++k) {
            const world::BlockIndex at = s * world::kBlocksPerSection + k;
            world::BlockValue value = valueIn(stored, at);
            if (valueIn(loaded, at) != value) blocks.push_back({world::blockPos(pos, at), std::move(value)});
        }
    }
    return blocks;
}

// Waits until no worker loads a chunk: the chunk may be that of before an edit.
void completeLoads(stream::ChunkPipeline& pipeline) {
    pipeline.update();
    while (pipeline.queuedCount() > 0) {
        pipeline.waitForWorkers(std::chrono::milliseconds(100));
        pipeline.update();
    }
}

// Draws the images of one world. Used on the thread of the context, which the first image makes.
class SceneDrawer {
  public:
    explicit SceneDrawer(const DrawnWorld& world) : world_(world), edited_(*world.opened) {}

    base::Result<base::Image> draw(const ImageRequest& request) {
        auto image = tryDraw(request);
        if (!image) release();
        return image;
    }

    // The next image makes all anew.
    void release() {
        scene_.reset();
        canvas_.reset();
    }

  private:
    base::Result<base::Image> tryDraw(const ImageRequest& request) {
        TERRANE_TRY(prepareScene(request));
        render::Renderer& renderer = canvas_->renderer;
        game::Session& session = scene_->session;
        const render::GraphicsSettings graphics =
            render::settingsOf({request.preset, {}, request.viewDistance}, canvas_->device.software);
        TERRANE_TRY(renderer.configure(request.size, graphics.render));
        setViewDistance(request.viewDistance);
        session.pipeline().setMeshOptions(graphics.mesh);
        scene_->view.setHorizon({request.horizon, graphics.detail});
        const render::Camera camera = view::cameraOf(request.pose, request.fieldOfView);
        view::loadAll(session, scene_->view, camera, request.viewDistance, Clock::now());
        renderer.completeLand();
        render::FrameInput input{camera,
                                 world::environmentAt(request.timeDay),
                                 view::fogDistance(scene_->view.visibleDistance()),
                                 0,
                                 render::View::Color,
                                 game::waterAbove(session, camera.position)};
        input.exposure = view::exposureFor(view::seenLight(session, input, render::aspectOf(request.size)));
        renderer.draw(input);
        return renderer.readImage();
    }

    // Brings the kept chunks up to date, or begins with none. A new scene comes before configure(), so that
    // shaders are compiled once.
    base::Result<void> prepareScene(const ImageRequest& request) {
        if (!canvas_) {
            auto canvas = TERRANE_TRY(makeCanvas(world_));
            canvas_ = std::move(canvas);
        }
        const auto edited = edited_.take();
        if (scene_ && !(world_.isOnlyWriter && update(edited))) scene_.reset();
        if (request.horizon > 0) TERRANE_TRY(world_.opened->waitForTiles());
        if (!scene_) {
            auto scene = TERRANE_TRY(makeScene(world_, *canvas_));
            scene_ = std::move(scene);
        }
        scene_->hasTiles = scene_->hasTiles || request.horizon > 0;
        return {};
    }

    // False if loading all chunks is simpler or faster.
    bool update(const std::unordered_set<world::ChunkPos, world::ChunkPosHash>& edited) {
        if (edited.empty()) return true;
        if (scene_->hasTiles || edited.size() > EditedChunks::kMost) return false;
        completeLoads(scene_->session.pipeline());
        constexpr std::size_t kMostBlocks = std::size_t{1} << 17;
        std::vector<world::PlacedBlock> blocks;
        for (const world::ChunkPos pos : edited) {
            const world::ChunkPtr loaded = scene_->session.world().maybeChunkAt(pos);
            if (!loaded) continue;
            const store::LoadedChunk stored = world_.opened->store().load(pos);
            if (!stored.chunk) return false;
            std::ranges::move(differences(*loaded, *stored.chunk, pos), std::back_inserter(blocks));
            if (blocks.size() > kMostBlocks) return false;
        }
        scene_->session.setBlocks(blocks);
        return true;
    }

    void setViewDistance(int chunks) {
        if (std::exchange(scene_->viewDistance, chunks) == chunks) return;
        canvas_->renderer.setViewDistance(chunks);
        scene_->session.pipeline().resendLight();
    }

    const DrawnWorld& world_;
    EditedChunks edited_;
    std::unique_ptr<Canvas> canvas_;
    std::unique_ptr<Scene> scene_;  // draws on the canvas
};

base::Result<base::Image> drawOrFail(SceneDrawer& drawer, const ImageRequest& request) {
    try {
        return drawer.draw(request);
    } catch (const std::exception& exception) {
        drawer.release();
        return base::fail("render: {}", base::textOf(exception));
    }
}

}  // namespace

base::Result<std::shared_ptr<ImageDrawer>> ImageDrawer::create(DrawnWorld world) {
    std::shared_ptr<ImageDrawer> drawer(new ImageDrawer(std::move(world)));
    try {
        drawer->thread_ = std::thread([&self = *drawer] { self.run(); });
    } catch (const std::system_error&) {
        return base::fail(base::ErrorCode::OutOfResources, "render: no thread can be started");
    }
    return drawer;
}

ImageDrawer::~ImageDrawer() {
    stop();
}

void ImageDrawer::stop() {
    {
        const std::lock_guard lock(mutex_);
        isStopped_ = true;
    }
    changed_.notify_all();
    const std::lock_guard lock(stopMutex_);
    if (thread_.joinable()) thread_.join();
}

base::Result<base::Image> ImageDrawer::draw(const ImageRequest& request) {
    std::future<base::Result<base::Image>> image;
    {
        const std::lock_guard lock(mutex_);
        if (isStopped_) return base::fail("render: the program ends");
        waiting_.push_back({request, {}});
        image = waiting_.back().image.get_future();
    }
    changed_.notify_all();
    return image.get();
}

std::optional<ImageDrawer::Waiting> ImageDrawer::nextRequest() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return isStopped_ || !waiting_.empty(); });
    if (isStopped_) return std::nullopt;
    std::optional<Waiting> next(std::move(waiting_.front()));
    waiting_.pop_front();
    return next;
}

void ImageDrawer::run() {
    {
        SceneDrawer drawer(world_);
        while (auto next = nextRequest()) next->image.set_value(drawOrFail(drawer, next->request));
    }
    const std::lock_guard lock(mutex_);
    for (Waiting& waiting : waiting_) waiting.image.set_value(base::fail("render: the program ends"));
    waiting_.clear();
}

}  // namespace terrane::python
