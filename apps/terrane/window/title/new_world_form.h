// The form for a new world: typed values and the world made from them. Pure; any thread.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "apps/terrane/options.h"
#include "apps/terrane/window/text.h"
#include "terrane/gpu/texture.h"
#include "terrane/pack/content.h"

namespace terrane::app {

// Draws a map of a new world on its own thread, coarse at first, then finer. A request for another world
// cancels the work on the last one. Used on the thread of the OpenGL context.
class MapPreview {
  public:
    static constexpr int kPixels = 256;  // per side, 16 blocks each

    struct World {
        std::string generator;
        std::uint64_t seed = 0;
        world::Heights heights;
        bool operator==(const World&) const = default;
    };

    explicit MapPreview(const pack::Content& content);  // outlives this
    ~MapPreview();                                      // waits for a row of chunks
    MapPreview(const MapPreview&) = delete;
    MapPreview& operator=(const MapPreview&) = delete;

    // Call each frame with the world to show. Uploads what the thread has drawn.
    void show(const World& world);
    // The OpenGL texture, 0 before the first one; the first row is the northern one.
    unsigned image() const { return texture_ ? texture_->id() : 0; }
    bool isComplete() const { return isComplete_; }
    const std::string& problem() const { return problem_; }

  private:
    struct Work;

    std::unique_ptr<Work> work_;
    std::unique_ptr<gpu::Texture2D> texture_;
    bool isComplete_ = false;
    std::string problem_;
};

// A world to play: an existing file, or a new one.
struct ChosenWorld {
    std::filesystem::path file;
    std::optional<store::WrittenSeed> seed;  // for a new world
    std::optional<std::string> generator;
    world::RequestedHeights heights;  // for a new world
    std::string mode = {};            // by game::kModeNames; empty: its own
};

struct NewWorldForm {
    std::string name;
    std::string seed;  // empty: randomSeed
    std::string generator;
    bool isSurvival = false;
    std::string bottom, top;  // empty: those of `declared`
    world::Heights declared;  // by the generator
    std::uint64_t randomSeed = 0;

    bool operator==(const NewWorldForm&) const = default;
};

// A form with the first free name of "World", "World 2", … and the default generator.
NewWorldForm newForm(const std::filesystem::path& folder, std::uint64_t randomSeed,
                     const pack::Content& content);

// Sets the generator and the heights that it declares.
void chooseGenerator(NewWorldForm& form, const std::string& name, const pack::Content& content);

// Ignores spaces around the seed.
[[nodiscard]] base::Result<store::WrittenSeed> seedOf(const NewWorldForm& form);

// The heights of the form's world. Fails unless they are those of a world.
[[nodiscard]] base::Result<world::Heights> heightsOf(const NewWorldForm& form);

// What the player is told about the seed of the form: the number that a text stands for, or the random one.
// Empty for a number, which tells itself.
std::string seedNote(const NewWorldForm& form, const store::WrittenSeed& seed, const Texts& tr);

// Errors are one line for the player.
[[nodiscard]] base::Result<ChosenWorld> worldOf(const NewWorldForm& form,
                                                const std::filesystem::path& folder);

}  // namespace terrane::app
