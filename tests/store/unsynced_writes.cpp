#include "tests/store/unsynced_writes.h"

#include <algorithm>

namespace terrane::store {
namespace {

constexpr std::size_t kSectorBytes = 512;

void overwrite(std::string& content, std::string_view data, std::size_t at) {
    if (content.size() < at + data.size()) content.resize(at + data.size());
    content.replace(at, data.size(), data);
}

bool flip(std::mt19937& random) {
    return random() % 2 == 0;
}

// Writes none or all of each sector, rarely its beginning.
void writeSomeSectors(std::string& content, std::string_view data, std::size_t at, std::mt19937& random) {
    for (std::size_t from = 0; from < data.size();) {
        const std::size_t end = std::min(data.size(), ((at + from) / kSectorBytes + 1) * kSectorBytes - at);
        const std::string_view sector = data.substr(from, end - from);
        if (flip(random)) {
            overwrite(content, random() % 8 == 0 ? sector.substr(0, random() % sector.size()) : sector,
                      at + from);
        }
        from = end;
    }
}

}  // namespace

void UnsyncedWrites::apply(std::string& content, const Change& change) {
    if (change.data) {
        overwrite(content, *change.data, change.at);
    } else {
        content.resize(change.at);
    }
}

void UnsyncedWrites::open(const std::string& path, const std::optional<std::string>& content,
                          bool isJournal) {
    Entry& entry = entries_[path];
    if (entry.file && content && entry.file->now == *content) return;
    if (content) {  // existed before, or was changed by others
        entry = {File{*content, *content, {}}, {}, true, isJournal};
        return;
    }
    if (entry.isFolderSynced) entry.onDisk = std::move(entry.file);
    entry.file = File{};
    entry.isFolderSynced = false;
    entry.syncsFolder = isJournal;
}

void UnsyncedWrites::write(const std::string& path, std::string_view data, std::size_t at) {
    const auto found = entries_.find(path);
    if (found == entries_.end() || !found->second.file) return;
    File& file = *found->second.file;
    apply(file.now, file.unsynced.emplace_back(Change{at, std::string(data)}));
}

void UnsyncedWrites::truncate(const std::string& path, std::size_t size) {
    const auto found = entries_.find(path);
    if (found == entries_.end() || !found->second.file) return;
    File& file = *found->second.file;
    apply(file.now, file.unsynced.emplace_back(Change{size, {}}));
}

void UnsyncedWrites::sync(const std::string& path) {
    const auto found = entries_.find(path);
    if (found == entries_.end() || !found->second.file) return;
    File& file = *found->second.file;
    file.synced = file.now;
    file.unsynced.clear();
    if (found->second.syncsFolder && !found->second.isFolderSynced) syncFolder();
}

void UnsyncedWrites::syncFolder() {
    for (auto& [path, entry] : entries_) {
        entry.isFolderSynced = true;
        entry.onDisk.reset();
    }
}

void UnsyncedWrites::remove(const std::string& path, bool syncsFolder) {
    const auto found = entries_.find(path);
    if (found != entries_.end()) {
        Entry& entry = found->second;
        if (entry.isFolderSynced) entry.onDisk = std::move(entry.file);
        entry.file.reset();
        entry.isFolderSynced = false;
    }
    if (syncsFolder) this->syncFolder();
}

UnsyncedWrites::Files UnsyncedWrites::afterKill() const {
    Files files;
    for (const auto& [path, entry] : entries_)
        files[path] = entry.file ? std::optional(entry.file->now) : std::nullopt;
    return files;
}

std::string UnsyncedWrites::imageOf(const File& file, std::mt19937& random) {
    std::string image = file.synced;
    const bool keepsAll = random() % 4 == 0, keepsNone = random() % 4 == 0;
    for (const Change& change : file.unsynced) {
        if (keepsAll) {
            apply(image, change);
        } else if (!keepsNone) {
            if (change.data) {
                writeSomeSectors(image, *change.data, change.at, random);
            } else if (flip(random)) {
                apply(image, change);
            }
        }
    }
    return image;
}

UnsyncedWrites::Files UnsyncedWrites::afterPowerLoss(std::mt19937& random) const {
    Files files;
    for (const auto& [path, entry] : entries_) {
        const std::optional<File>& kept = entry.isFolderSynced || flip(random) ? entry.file : entry.onDisk;
        files[path] = kept ? std::optional(imageOf(*kept, random)) : std::nullopt;
    }
    return files;
}

}  // namespace terrane::store
