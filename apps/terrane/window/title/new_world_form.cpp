#include "apps/terrane/window/title/new_world_form.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <charconv>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <thread>
#include <utility>

#include "terrane/base/job_system.h"
#include "terrane/base/names.h"
#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/game/player_items.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/map/area_image.h"
#include "terrane/store/saves/world_list.h"

namespace terrane::app {

namespace {

constexpr int kLevels[] = {6, 5, 4};  // chunks of a level are 1024, 512, 256 blocks wide
constexpr int kBlocks = 16 * MapPreview::kPixels;

}  // namespace

struct MapPreview::Work {
    explicit Work(const pack::Content& given) : content(given), thread([this] { run(); }) {}
    ~Work() {
        {
            const std::lock_guard lock(mutex);
            isEnding = true;
        }
        changed.notify_all();
        thread.join();
    }

    void run();
    // Requests have numbers, since the same world may be requested again while another is drawn.
    void draw(const World& world, std::uint64_t request);
    bool isOutdated(std::uint64_t request) {
        const std::lock_guard lock(mutex);
        return isEnding || newest != request;
    }
    void give(std::uint64_t request, base::Result<base::Image> image, bool isLast) {
        const std::lock_guard lock(mutex);
        if (newest != request) return;
        if (image) drawn = std::move(*image);
        problem = image ? "" : image.error().message;
        isDone = isLast || !image;
    }

    const pack::Content& content;
    std::mutex mutex;
    std::condition_variable changed;
    // Guarded by the mutex.
    std::optional<World> wanted;
    std::uint64_t newest = 0;          // request
    std::optional<base::Image> drawn;  // not yet shown
    bool isDone = false, isEnding = false;
    std::string problem;
    base::JobSystem jobs{1};
    std::thread thread;  // last: starts after all members
};

void MapPreview::Work::run() {
    base::setThreadName("map preview");
    std::uint64_t last = 0;
    while (true) {
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return isEnding || newest != last; });
        if (isEnding) return;
        last = newest;
        const World world = *wanted;
        lock.unlock();
        try {
            draw(world, last);
        } catch (const std::exception& error) {  // no memory
            give(last, base::fail("{}", base::textOf(error)), true);
        }
    }
}

void MapPreview::Work::draw(const World& world, std::uint64_t request) {
    auto generators = gen::makeLevelGenerators(world.generator, *content.blocks, world.seed,
                                               content.generators, world.heights);
    if (!generators) return give(request, tl::unexpected(generators.error()), true);
    auto painter = map::MapPainter::create({*generators, *content.blocks, content.textures});
    if (!painter) return give(request, tl::unexpected(painter.error()), true);
    for (const int level : kLevels) {
        if (isOutdated(request)) return;
        const std::int32_t half = kBlocks / 2 / (16 << level);
        const map::ColumnRect rect = map::columnsOf({-half, -half, half, half}, level);
        auto image = map::drawArea(*painter, rect, {}, jobs, [&](int) { return !isOutdated(request); });
        give(request, std::move(image), level == std::end(kLevels)[-1]);
    }
}

MapPreview::MapPreview(const pack::Content& content) : work_(std::make_unique<Work>(content)) {}
MapPreview::~MapPreview() = default;

void MapPreview::show(const World& world) {
    std::optional<base::Image> image;
    bool isNew = false;
    {
        const std::lock_guard lock(work_->mutex);
        isNew = work_->wanted != world;
        if (isNew) {
            work_->wanted = world;
            ++work_->newest;
            work_->drawn.reset();
            work_->isDone = false;
            work_->problem.clear();
        }
        image = std::exchange(work_->drawn, std::nullopt);
        isComplete_ = work_->isDone;
        problem_ = work_->problem;
    }
    if (isNew) work_->changed.notify_all();
    if (!image) return;
    texture_ =
        std::make_unique<gpu::Texture2D>(glm::ivec2(image->width, image->height), GL_RGBA8, 1, "map preview");
    texture_->upload(0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(image->rgba)));
}

namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpaces = " \t";
    const std::size_t first = text.find_first_not_of(kSpaces);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

// A whole number, or none for an empty text.
base::Result<std::optional<int>> typedHeight(std::string_view text) {
    text = trimmed(text);
    if (text.empty()) return std::nullopt;
    int height = 0;
    const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), height);
    if (error == std::errc() && next == text.data() + text.size()) return height;
    return base::fail(base::ErrorCode::BadInput,
                      "bottom and top: expected multiples of {} from {} to {}, got \"{}\"",
                      world::kSectionSize, world::kLowestBottom, world::kHighestTop, text);
}

base::Result<world::RequestedHeights> typedHeights(const NewWorldForm& form) {
    const auto bottom = TERRANE_TRY(typedHeight(form.bottom));
    const auto top = TERRANE_TRY(typedHeight(form.top));
    return world::RequestedHeights(bottom, top);
}

}  // namespace

NewWorldForm newForm(const std::filesystem::path& folder, std::uint64_t randomSeed,
                     const pack::Content& content) {
    NewWorldForm form;
    chooseGenerator(form, gen::kDefaultGenerator, content);
    form.name = store::unusedWorldName(folder, "World");
    form.randomSeed = randomSeed;
    return form;
}

base::Result<store::WrittenSeed> seedOf(const NewWorldForm& form) {
    const std::string_view text = trimmed(form.seed);
    if (text.empty()) return store::WrittenSeed{form.randomSeed, ""};
    return store::seedFrom(text);
}

void chooseGenerator(NewWorldForm& form, const std::string& name, const pack::Content& content) {
    form.generator = name;
    // A broken generator is told by the map.
    form.declared = gen::heightsOf(name, *content.blocks, {}, content.generators).value_or(world::Heights());
}

base::Result<world::Heights> heightsOf(const NewWorldForm& form) {
    const world::Heights heights = TERRANE_TRY(typedHeights(form)).over(form.declared);
    TERRANE_TRY(world::checkHeights(heights));
    return heights;
}

std::string seedNote(const NewWorldForm& form, const store::WrittenSeed& seed, const Texts& tr) {
    if (!seed.text.empty()) return fmt::format(fmt::runtime(tr("The text becomes the number {}")), seed.seed);
    if (trimmed(form.seed).empty()) return fmt::format(fmt::runtime(tr("Random number {}")), seed.seed);
    return {};
}

base::Result<ChosenWorld> worldOf(const NewWorldForm& form, const std::filesystem::path& folder) {
    const std::string name = base::normalizedName(trimmed(form.name));
    if (name.empty()) return base::fail(base::ErrorCode::BadInput, "a world needs a name");
    TERRANE_TRY(store::checkNewWorld(folder, name));
    auto seed = seedOf(form);
    if (!seed) return base::fail(base::ErrorCode::BadInput, "seed: {}", seed.error().message);
    (void)TERRANE_TRY(heightsOf(form));
    constexpr auto kSurvival = static_cast<std::size_t>(game::Mode::Survival);
    return ChosenWorld{store::worldFile(folder, name), std::move(*seed), form.generator,
                       TERRANE_TRY(typedHeights(form)),
                       form.isSurvival ? std::string(game::kModeNames[kSurvival]) : std::string()};
}

}  // namespace terrane::app
