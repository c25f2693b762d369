#include "terrane/render/frame/background_compiler.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"
#include "terrane/gpu/context.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/render/frame/renderer.h"

namespace terrane::render {
namespace {

// Idle time after which the context and its memory are freed.
constexpr std::chrono::seconds kIdle{10};

// Drivers may have other programs for textures whose sides are powers of two.
int smallSide(int pixels) {
    return std::has_single_bit(static_cast<unsigned>(pixels)) ? 64 : 96;
}

// Ground with every block type on it side by side: each shader has something to draw.
world::Chunk sampleChunk(const world::BlockRegistry& blocks) {
    constexpr int kGround = 64;
    world::Chunk chunk;
    for (int k = 0; k < world::kChunkSize * world::kChunkSize; ++k) {
        const int x = k % world::kChunkSize, y = k / world::kChunkSize;
        chunk.setBlock(world::blockIndex(x, y, kGround), 1);
        chunk.setBlock(world::blockIndex(x, y, kGround + 1),
                       static_cast<world::BlockId>(1 + k % blocks.missing()));
    }
    return chunk;
}

// Options that select the same programs, with a small shadow map. An image that is enlarged takes all
// programs of one that is not.
RenderOptions withTheSamePrograms(RenderOptions options) {
    options.shadowSize = 256;
    options.animation = options.distanceFog = true;
    options.renderScale = options.renderScale > 100 ? 200 : 50;
    return options;
}

FrameInput sampleInput() {
    FrameInput input;
    input.camera = {{-6, 8, 70}, 0, -20};
    input.environment = world::environmentAt(0.4f);  // sun, so that there are shadows
    return input;
}

}  // namespace

struct BackgroundCompiler::State {
    struct Request {
        glm::ivec2 size;  // of the small image
        RenderOptions options;
        WorldFeatures features;

        bool operator==(const Request&) const = default;
    };

    State(const gpu::ShaderLoader& loader, const world::BlockRegistry& registry, TextureSource source)
        : shaders(loader), blocks(registry), textures(std::move(source)) {}

    const gpu::ShaderLoader& shaders;
    const world::BlockRegistry& blocks;

    std::mutex mutex;  // guards the members below
    TextureSource textures;
    std::condition_variable changed;
    std::optional<Request> next, current;
    std::vector<Request> ready;
    bool hasNewTextures = false;  // since the thread made its renderer
    bool isUseless = false;       // no context: everything counts as ready
    bool isEnding = false;
    std::thread thread;

    bool isReady(const Request& request) const {
        return isUseless || std::ranges::find(ready, request) != ready.end();
    }
    bool waitForNext();
    TextureSource takeTextures();
    std::optional<Request> takeNext();
    void run();
    base::Result<void> compileUntilIdle();
};

// False when the thread is to end.
bool BackgroundCompiler::State::waitForNext() {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return next || isEnding; });
    return !isEnding;
}

TextureSource BackgroundCompiler::State::takeTextures() {
    const std::lock_guard lock(mutex);
    hasNewTextures = false;
    return textures;
}

// None if nothing was requested for a while, or the thread is to end or needs another renderer.
std::optional<BackgroundCompiler::State::Request> BackgroundCompiler::State::takeNext() {
    std::unique_lock lock(mutex);
    changed.wait_for(lock, kIdle, [&] { return next || isEnding; });
    if (isEnding || hasNewTextures) return std::nullopt;
    current = std::exchange(next, std::nullopt);
    return current;
}

base::Result<void> BackgroundCompiler::State::compileUntilIdle() {
    const auto context = TERRANE_TRY(gpu::HeadlessContext::create({}));
    auto renderer = TERRANE_TRY(Renderer::create(shaders, blocks, takeTextures(), gpu::queryDevice()));
    renderer.setViewDistance(1);
    renderer.setChunk({0, 0}, mesh::meshAlone(sampleChunk(blocks), blocks));
    renderer.setLight({0, 0}, light::ChunkLight());
    while (const std::optional<Request> request = takeNext()) {
        TERRANE_ZONE("compile shaders");
        const auto configure = [&]() -> base::Result<void> {
            TERRANE_TRY(renderer.useLand(request->features.hasLand));
            TERRANE_TRY(renderer.useTint(request->features.hasTint));
            return renderer.configure(request->size, request->options);
        };
        if (configure()) {
            // All quads count as hidden before the first frame, so its late pass draws them; in the second
            // the early pass does.
            for (int frame = 0; frame < 2; ++frame) renderer.draw(sampleInput());
            glFinish();
        }
        // The renderer reports options that the driver does not support.
        const std::lock_guard lock(mutex);
        if (!hasNewTextures) ready.push_back(*request);
        current.reset();
    }
    return {};
}

void BackgroundCompiler::State::run() {
    while (waitForNext()) {
        const auto done = compileUntilIdle();
        if (done) continue;
        base::logWarning("shaders are compiled when they are first needed: {}", done.error().message);
        const std::lock_guard lock(mutex);
        isUseless = true;
        return;
    }
}

BackgroundCompiler::BackgroundCompiler(const gpu::ShaderLoader& shaders, const world::BlockRegistry& blocks,
                                       TextureSource textures)
    : state_(std::make_unique<State>(shaders, blocks, std::move(textures))) {}

BackgroundCompiler::~BackgroundCompiler() {
    if (!state_ || !state_->thread.joinable()) return;
    {
        const std::lock_guard lock(state_->mutex);
        state_->isEnding = true;
    }
    state_->changed.notify_one();
    state_->thread.join();
}

void BackgroundCompiler::setTextures(TextureSource textures) {
    const std::lock_guard lock(state_->mutex);
    state_->textures = std::move(textures);
    state_->hasNewTextures = true;
    state_->ready.clear();
}

bool BackgroundCompiler::isReady(glm::ivec2 size, const RenderOptions& options,
                                 const WorldFeatures& features) {
    const State::Request request{
        {smallSide(size.x), smallSide(size.y)}, withTheSamePrograms(options), features};
    const std::lock_guard lock(state_->mutex);
    if (state_->isReady(request)) return true;
    if (state_->current == request) return false;
    state_->next = request;
    try {
        // A user who never changes an option needs no thread.
        if (!state_->thread.joinable())
            state_->thread = std::thread([state = state_.get()] { state->run(); });
    } catch (const std::system_error& error) {
        base::logWarning("shaders are compiled when they are first needed: no thread can be started: {}",
                         error.what());
        return state_->isUseless = true;
    }
    state_->changed.notify_one();
    return false;
}

}  // namespace terrane::render
