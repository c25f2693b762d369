// Simulates the contents of files after a power failure. Until a file is synced, each written sector of 512
// bytes may be on disk or not, in any order; the last one may be partial, and an extended file may contain
// zeros. Directory entries (created and deleted files) are on disk once the folder is synced. Bytes that were
// not written keep their value: SQLite assumes this of every disk ("powersafe overwrite").
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace terrane::store {

class UnsyncedWrites {
  public:
    using Files = std::map<std::string, std::optional<std::string>>;  // content by path; no value: no file

    // `content` is already on disk. `isJournal`: syncing the new file also syncs its folder, as SQLite does
    // for journals and logs.
    void open(const std::string& path, const std::optional<std::string>& content, bool isJournal);
    void write(const std::string& path, std::string_view data, std::size_t at);
    void truncate(const std::string& path, std::size_t size);
    void sync(const std::string& path);
    void remove(const std::string& path, bool syncsFolder);

    Files afterKill() const;
    Files afterPowerLoss(std::mt19937& random) const;

  private:
    struct Change {
        std::size_t at = 0;               // or the new size
        std::optional<std::string> data;  // no value: truncated
    };
    // A file with a name; a deleted and recreated name has a new File.
    struct File {
        std::string synced, now;
        std::vector<Change> unsynced;
    };
    struct Entry {
        std::optional<File> file;    // no value: deleted
        std::optional<File> onDisk;  // the file of this name until the folder is synced
        bool isFolderSynced = true;
        bool syncsFolder = false;
    };
    static std::string imageOf(const File& file, std::mt19937& random);
    static void apply(std::string& content, const Change& change);
    void syncFolder();

    std::map<std::string, Entry> entries_;
};

}  // namespace terrane::store
