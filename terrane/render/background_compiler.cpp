#include "terrane/render/background_compiler.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"
#include "terrane/gpu/context.h"
#include "terrane/gpu/device_info.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/render/renderer.h"

namespace terrane::render {
namespace {

// Idle time after which the context and its memory are freed.
constexpr std::chrono::seconds kIdle{10};

constexpr int kSmallShadowMap = 256;  // texels a side: programs do not depend on it

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

FrameInput sampleInput() {
    FrameInput input;
    input.camera = {{-6, 8, 70}, 0, -20};
    input.environment = world::environmentAt(0.4f);  // sun, so that there are shadows
    return input;
}

}  // namespace

struct BackgroundCompiler::State {
    struct Wanted {
        glm::ivec2 size;  // of the small image
        RenderOptions options;
        WorldFeatures features;

        bool operator==(const Wanted&) const = default;
    };

    State(const gpu::ShaderLoader& loader, const world::BlockRegistry& registry, TextureSource source)
        : shaders(loader), blocks(registry), textures(std::move(source)) {}

    const gpu::ShaderLoader& shaders;
    const world::BlockRegistry& blocks;
    TextureSource textures;

    std::mutex mutex;  // guards the members below
    std::condition_variable changed;
    std::optional<Wanted> next, current;
    std::vector<Wanted> ready;
    bool isUseless = false;  // no context: everything counts as ready
    bool isEnding = false;
    std::thread thread;

    bool isReady(const Wanted& wanted) const {
        return isUseless || std::ranges::find(ready, wanted) != ready.end();
    }
    bool waitForNext();
    std::optional<Wanted> takeNext();
    void run();
    base::Result<void> compileUntilIdle();
};

// False when the thread is to end.
bool BackgroundCompiler::State::waitForNext() {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return next || isEnding; });
    return !isEnding;
}

// None if nothing was requested for a while, or the thread is to end.
std::optional<BackgroundCompiler::State::Wanted> BackgroundCompiler::State::takeNext() {
    std::unique_lock lock(mutex);
    changed.wait_for(lock, kIdle, [&] { return next || isEnding; });
    if (isEnding) return std::nullopt;
    current = std::exchange(next, std::nullopt);
    return current;
}

base::Result<void> BackgroundCompiler::State::compileUntilIdle() {
    auto context = gpu::HeadlessContext::create({});
    if (!context) return tl::unexpected(context.error());
    auto renderer = Renderer::create(shaders, blocks, textures, gpu::queryDevice());
    if (!renderer) return tl::unexpected(renderer.error());
    renderer->setViewDistance(1);
    renderer->setChunk({0, 0}, mesh::meshAlone(sampleChunk(blocks), blocks));
    renderer->setLight({0, 0}, light::ChunkLight());
    while (const std::optional<Wanted> wanted = takeNext()) {
        TERRANE_ZONE("compile shaders");
        RenderOptions options = wanted->options;
        options.shadowSize = kSmallShadowMap;
        const auto configure = [&]() -> base::Result<void> {
            if (auto used = renderer->useLand(wanted->features.hasLand); !used) return used;
            if (auto used = renderer->useTint(wanted->features.hasTint); !used) return used;
            return renderer->configure(wanted->size, options);
        };
        if (configure()) {
            // All quads count as hidden before the first frame, so its late pass draws them; in the second
            // the early pass does.
            for (int frame = 0; frame < 2; ++frame) renderer->draw(sampleInput());
            glFinish();
        }
        // The renderer reports options that the driver does not support.
        const std::lock_guard lock(mutex);
        ready.push_back(*wanted);
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

bool BackgroundCompiler::isReady(glm::ivec2 size, const RenderOptions& options,
                                 const WorldFeatures& features) {
    const State::Wanted wanted{{smallSide(size.x), smallSide(size.y)}, options, features};
    const std::lock_guard lock(state_->mutex);
    if (state_->isReady(wanted)) return true;
    if (state_->current == wanted) return false;
    state_->next = wanted;
    // A user who never changes an option needs no thread.
    if (!state_->thread.joinable()) state_->thread = std::thread([state = state_.get()] { state->run(); });
    state_->changed.notify_one();
    return false;
}

}  // namespace terrane::render
