// The player's worlds as the title screen lists them: their pictures, which one is chosen, and a copy that is
// being made. Used on the thread of the OpenGL context.
#pragma once

#include <atomic>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "terrane/gpu/texture.h"
#include "terrane/store/world_list.h"

namespace terrane::app {

class WorldShelf {
  public:
    // `blocks` outlives this.
    WorldShelf(std::filesystem::path folder, const world::BlockRegistry& blocks);
    ~WorldShelf();  // cancels a copy
    WorldShelf(const WorldShelf&) = delete;
    WorldShelf& operator=(const WorldShelf&) = delete;

    void reload();  // looks into the folder again; the chosen name stays chosen
    const std::vector<store::WorldEntry>& worlds() const { return worlds_; }
    const store::WorldEntry* chosen() const;  // null: there is none
    void choose(std::size_t index) { chosen_ = index; }
    // The last played one that can be played; null: there is none.
    const store::WorldEntry* last() const;
    // The OpenGL texture of a world's picture, 0: none. Read when it is first asked for.
    unsigned picture(const store::WorldEntry& world);

    // Of the chosen world. Errors are one line for the player.
    [[nodiscard]] base::Result<void> rename(const std::string& newName);
    [[nodiscard]] base::Result<void> remove();
    void startCopy(const std::string& newName);
    // A copy is being made: how much of it is done.
    bool isCopying() const { return copying_.valid(); }
    float copied() const { return share_.load(); }
    void cancelCopy() { isCancelled_ = true; }
    // Once a copy has ended: what went wrong, or nothing. None before.
    std::optional<base::Result<void>> takeCopy();

  private:
    std::filesystem::path folder_;
    const world::BlockRegistry* blocks_;
    std::vector<store::WorldEntry> worlds_;
    std::size_t chosen_ = 0;
    std::map<std::string, gpu::Texture2D> pictures_;  // by name; empty ones where there is none
    std::string copyName_;
    std::future<base::Result<void>> copying_;
    std::atomic<float> share_{0};
    std::atomic<bool> isCancelled_{false};
};

// "continents, seed 12, 4.2 MB, today 14:03"; what is wrong with it instead.
std::string describe(const store::WorldEntry& world);

}  // namespace terrane::app
