// What files hold after the power went. Until a file is synced, each sector of 512 bytes that was written to
// it may be on the disk or not, in any order, the last one may hold a part of what was written, and a file
// that was extended may have zeros there. Entries of the folder (files made and deleted) are on the disk once
// the folder was synced. Bytes that nobody wrote stay as they are: SQLite takes that for granted of every
// disk ("powersafe overwrite").
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
    using Files = std::map<std::string, std::optional<std::string>>;  // content by path; nothing: no file

    // `content` is on the disk already. `isJournal`: syncing the new file syncs its folder too, as SQLite
    // does for journals and logs.
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
        std::optional<std::string> data;  // nothing: truncated
    };
    // One file under a name. A name has a newer one when it was deleted and made again.
    struct File {
        std::string synced, now;
        std::vector<Change> unsynced;
    };
    struct Entry {
        std::optional<File> file;    // nothing: deleted
        std::optional<File> onDisk;  // what the name stands for until the folder is synced
        bool isFolderSynced = true;
        bool syncsFolder = false;
    };
    static std::string imageOf(const File& file, std::mt19937& random);
    static void apply(std::string& content, const Change& change);
    void syncFolder();

    std::map<std::string, Entry> entries_;
};

}  // namespace terrane::store
