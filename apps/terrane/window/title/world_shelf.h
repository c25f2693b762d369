// The list of worlds of the title screen: thumbnails, the chosen world, and a running copy. Used on the
// thread of the OpenGL context.
#pragma once

#include <atomic>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "terrane/gpu/texture.h"
#include "terrane/store/saves/world_list.h"

namespace terrane::app {

class WorldShelf {
  public:
    // `blocks` outlives this.
    WorldShelf(std::filesystem::path folder, const world::BlockRegistry& blocks);
    ~WorldShelf();  // cancels a copy
    WorldShelf(const WorldShelf&) = delete;
    WorldShelf& operator=(const WorldShelf&) = delete;

    void reload();  // reads the folder again; keeps the chosen name
    const std::vector<store::WorldEntry>& worlds() const { return worlds_; }
    const store::WorldEntry* chosen() const;  // null: there is none
    void choose(std::size_t index) { chosen_ = index; }
    // The last played world that can be opened; null: none.
    const store::WorldEntry* last() const;
    // The OpenGL texture of a world's thumbnail, 0: none. Read at the first request.
    unsigned picture(const store::WorldEntry& world);

    // Change the chosen world. Errors are one line for the player.
    [[nodiscard]] base::Result<void> rename(const std::string& newName);
    [[nodiscard]] base::Result<void> remove();
    void startCopy(const std::string& newName);
    // Whether a copy is running, and its progress, 0 to 1.
    bool isCopying() const { return copying_.valid(); }
    float copied() const { return share_.load(); }
    void cancelCopy() { isCancelled_ = true; }
    // The result of a finished copy, once; none while it runs.
    std::optional<base::Result<void>> takeCopy();

  private:
    std::filesystem::path folder_;
    const world::BlockRegistry* blocks_;
    std::vector<store::WorldEntry> worlds_;
    std::size_t chosen_ = 0;
    std::map<std::string, gpu::Texture2D> pictures_;  // by name; empty for worlds without one
    std::string copyName_;
    std::future<base::Result<void>> copying_;
    std::atomic<float> share_{0};
    std::atomic<bool> isCancelled_{false};
};

// "continents, seed 12, 4.2 MB, today 14:03"; for a damaged world, its problem.
std::string describe(const store::WorldEntry& world);

}  // namespace terrane::app
