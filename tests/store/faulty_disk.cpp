#include "tests/store/faulty_disk.h"

#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <utility>

#include "tests/base/failing_memory.h"
#include "tests/store/unsynced_writes.h"

namespace terrane::store {
namespace {

// One disk at a time, since SQLite's callbacks only know files.
struct DiskState {
    std::mutex mutex;
    unsigned failingKinds = 0;
    DiskError error = DiskError::Io;
    long counted = 0, failFrom = 0, failUntil = 0, failed = 0;

    UnsyncedWrites unsynced;
    UnsyncedWrites::Files left;  // files left by the stop
    DiskStop stop = DiskStop::Kill;
    bool hasStopped = false;
    long changed = 0, stopFrom = LONG_MAX;
    std::mt19937 random;
    std::uint64_t history = 0xCBF2'9CE4'8422'2325;

    // SQLite requests random numbers while it holds its own mutex, which other calls lock in the opposite
    // order.
    std::mutex sqliteMutex;
    std::mt19937 sqliteRandom;
};
DiskState* disk = nullptr;
thread_local bool isHalved = false;  // applies to the next system call

constexpr unsigned kChanges = kDiskOpen | kDiskWrite | kDiskTruncate | kDiskSync | kDiskDelete;

// The outcome of an operation.
enum class Fate { Works, Fails, IsCutShort, IsLost };

// Call with the mutex held.
void remember(std::uint64_t value) {
    disk->history = (disk->history ^ value) * 0x100'0000'01B3;
}

Fate fateOf(DiskOperation kind, std::int64_t at = 0, int bytes = 0) {
    remember(kind);
    remember(static_cast<std::uint64_t>(at));
    remember(static_cast<std::uint64_t>(bytes));
    if (disk->hasStopped) return Fate::IsLost;
    if ((kind & kChanges) != 0 && disk->changed++ >= disk->stopFrom) return Fate::IsCutShort;
    if ((disk->failingKinds & kind) == 0) return Fate::Works;
    const long number = disk->counted++;
    if (number < disk->failFrom || number >= disk->failUntil) return Fate::Works;
    isHalved = disk->error == DiskError::Short;
    if (isHalved) return Fate::Works;
    ++disk->failed;
    return Fate::Fails;
}

// System calls; an operation makes as many as needed. The thread that halves holds the mutex.
std::size_t halvedOnce(std::size_t bytes) {
    if (!std::exchange(isHalved, false)) return bytes;
    ++disk->failed;
    return (bytes + 1) / 2;
}
ssize_t readHalf(int file, void* to, size_t bytes, off64_t at) {
    return ::pread64(file, to, halvedOnce(bytes), at);
}
ssize_t writeHalf(int file, const void* from, size_t bytes, off64_t at) {
    return ::pwrite64(file, from, halvedOnce(bytes), at);
}
void setSystemCalls(sqlite3_vfs* real, bool areOurs) {
    const auto read = reinterpret_cast<sqlite3_syscall_ptr>(readHalf);
    const auto write = reinterpret_cast<sqlite3_syscall_ptr>(writeHalf);
    for (const char* name : {"pread", "pread64"}) real->xSetSystemCall(real, name, areOurs ? read : nullptr);
    for (const char* name : {"pwrite", "pwrite64"})
        real->xSetSystemCall(real, name, areOurs ? write : nullptr);
}

std::optional<std::string> contentOfFile(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(file), {});
}

void stopHere() {
    disk->hasStopped = true;
    const bool isKill = disk->stop == DiskStop::Kill;
    disk->left = isKill ? disk->unsynced.afterKill() : disk->unsynced.afterPowerLoss(disk->random);
    // The lock file of terrane/store/saves/file_lock.h, which SQLite does not know: it may be complete, or
    // lack its last content.
    for (const auto& [path, content] : UnsyncedWrites::Files(disk->left)) {
        auto lock = contentOfFile(path + "-lock");
        if (!lock || lock->empty()) continue;
        if (!isKill && disk->random() % 3 == 0) lock = lock->substr(0, lock->find(' '));
        if (isKill || disk->random() % 4 != 0) disk->left[path + "-lock"] = lock;
    }
}

// The error code of a failure. Writes and new files need disk space.
int codeOf(DiskOperation kind, int code) {
    const bool needsRoom = (kind & (kDiskWrite | kDiskOpen | kDiskMap)) != 0;
    return disk->error == DiskError::Full && needsRoom ? SQLITE_FULL : code;
}

struct File {
    sqlite3_file base;
    sqlite3_file* real;  // after this one in memory
    const char* name;    // owned by SQLite while the file is open; null: ignored
};

sqlite3_file* realOf(sqlite3_file* file) {
    return reinterpret_cast<File*>(file)->real;
}
sqlite3_vfs* realOf(sqlite3_vfs* vfs) {
    return static_cast<sqlite3_vfs*>(vfs->pAppData);
}

// Runs `change`, which records the operation, if it works, or randomly if it is cut short: then it happened
// before the stop.
template <class Change, class Run>
int changing(DiskOperation kind, int code, std::int64_t at, int bytes, Change change, Run run) {
    const base::EnoughMemory enough;
    const std::lock_guard lock(disk->mutex);
    const Fate fate = fateOf(kind, at, bytes);
    if (fate == Fate::IsCutShort) {
        if (disk->random() % 2 == 0) change();
        stopHere();
    }
    if (fate != Fate::Works) return codeOf(kind, code);
    const int done = run();
    if (done == SQLITE_OK) change();
    return done;
}

template <class Run>
int unlessFailing(DiskOperation kind, int code, Run run) {
    const base::EnoughMemory enough;
    const std::lock_guard lock(disk->mutex);
    return fateOf(kind) == Fate::Works ? run() : codeOf(kind, code);
}

template <class Account>
void ofNamed(sqlite3_file* file, Account account) {
    if (const char* name = reinterpret_cast<File*>(file)->name) account(std::string(name));
}

int readFile(sqlite3_file* file, void* to, int bytes, sqlite3_int64 at) {
    const base::EnoughMemory enough;
    const std::lock_guard lock(disk->mutex);
    if (fateOf(kDiskRead, at, bytes) != Fate::Works) return SQLITE_IOERR_READ;
    return realOf(file)->pMethods->xRead(realOf(file), to, bytes, at);
}

int writeFile(sqlite3_file* file, const void* from, int bytes, sqlite3_int64 at) {
    const std::string_view data(static_cast<const char*>(from), static_cast<std::size_t>(bytes));
    return changing(
        kDiskWrite, SQLITE_IOERR_WRITE, at, bytes,
        [&] {
            ofNamed(file, [&](const std::string& name) {
                disk->unsynced.write(name, data, static_cast<std::size_t>(at));
            });
        },
        [&] { return realOf(file)->pMethods->xWrite(realOf(file), from, bytes, at); });
}

int truncateFile(sqlite3_file* file, sqlite3_int64 size) {
    return changing(
        kDiskTruncate, SQLITE_IOERR_TRUNCATE, size, 0,
        [&] {
            ofNamed(file, [&](const std::string& name) {
                disk->unsynced.truncate(name, static_cast<std::size_t>(size));
            });
        },
        [&] { return realOf(file)->pMethods->xTruncate(realOf(file), size); });
}

// Does not sync the real disk, since power failures are simulated.
int syncFile(sqlite3_file* file, int) {
    return changing(
        kDiskSync, SQLITE_IOERR_FSYNC, 0, 0,
        [&] { ofNamed(file, [](const std::string& name) { disk->unsynced.sync(name); }); },
        [] { return SQLITE_OK; });
}

// A killed program leaves the index of the log.
int unmapFile(sqlite3_file* file, int isDeleted) {
    const std::lock_guard lock(disk->mutex);
    return realOf(file)->pMethods->xShmUnmap(realOf(file), disk->hasStopped ? 0 : isDeleted);
}

const sqlite3_io_methods kMethods = {
    .iVersion = 2,
    .xClose = [](sqlite3_file* f) { return realOf(f)->pMethods->xClose(realOf(f)); },
    .xRead = readFile,
    .xWrite = writeFile,
    .xTruncate = truncateFile,
    .xSync = syncFile,
    .xFileSize = [](sqlite3_file* f,
                    sqlite3_int64* size) { return realOf(f)->pMethods->xFileSize(realOf(f), size); },
    .xLock =
        [](sqlite3_file* f, int lock) {
            return unlessFailing(kDiskLock, SQLITE_IOERR_LOCK,
                                 [&] { return realOf(f)->pMethods->xLock(realOf(f), lock); });
        },
    .xUnlock = [](sqlite3_file* f, int lock) { return realOf(f)->pMethods->xUnlock(realOf(f), lock); },
    .xCheckReservedLock = [](sqlite3_file* f,
                             int* out) { return realOf(f)->pMethods->xCheckReservedLock(realOf(f), out); },
    .xFileControl = [](sqlite3_file* f, int what,
                       void* value) { return realOf(f)->pMethods->xFileControl(realOf(f), what, value); },
    .xSectorSize = [](sqlite3_file* f) { return realOf(f)->pMethods->xSectorSize(realOf(f)); },
    .xDeviceCharacteristics =
        [](sqlite3_file* f) { return realOf(f)->pMethods->xDeviceCharacteristics(realOf(f)); },
    .xShmMap =
        [](sqlite3_file* f, int page, int bytes, int extend, void volatile** out) {
            return unlessFailing(kDiskMap, SQLITE_IOERR_SHMMAP, [&] {
                return realOf(f)->pMethods->xShmMap(realOf(f), page, bytes, extend, out);
            });
        },
    .xShmLock =
        [](sqlite3_file* f, int first, int count, int flags) {
            const auto run = [&] { return realOf(f)->pMethods->xShmLock(realOf(f), first, count, flags); };
            // Releasing a lock does not fail.
            return (flags & SQLITE_SHM_UNLOCK) != 0 ? run()
                                                    : unlessFailing(kDiskLock, SQLITE_IOERR_SHMLOCK, run);
        },
    .xShmBarrier = [](sqlite3_file* f) { realOf(f)->pMethods->xShmBarrier(realOf(f)); },
    .xShmUnmap = unmapFile,
    .xFetch = nullptr,
    .xUnfetch = nullptr,
};

int openFile(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* outFlags) {
    auto* opened = reinterpret_cast<File*>(file);
    opened->real = reinterpret_cast<sqlite3_file*>(opened + 1);
    opened->base.pMethods = nullptr;  // nothing to close
    opened->real->pMethods = nullptr;
    opened->name = name;
    constexpr int kJournals = SQLITE_OPEN_MAIN_JOURNAL | SQLITE_OPEN_SUPER_JOURNAL | SQLITE_OPEN_WAL;
    std::optional<std::string> before;
    const auto run = [&] {
        if (name) before = contentOfFile(name);
        return realOf(vfs)->xOpen(realOf(vfs), name, opened->real, flags, outFlags);
    };
    const auto account = [&] {
        if (name && opened->real->pMethods) disk->unsynced.open(name, before, (flags & kJournals) != 0);
    };
    const int code = changing(kDiskOpen, SQLITE_CANTOPEN, 0, flags, account, run);
    if (code == SQLITE_OK) opened->base.pMethods = &kMethods;
    return code;
}

int deleteFile(sqlite3_vfs* vfs, const char* name, int syncsFolder) {
    return changing(
        kDiskDelete, SQLITE_IOERR_DELETE, 0, 0, [&] { disk->unsynced.remove(name, syncsFolder != 0); },
        [&] { return realOf(vfs)->xDelete(realOf(vfs), name, syncsFolder); });
}

int randomBytes(sqlite3_vfs*, int count, char* out) {
    const std::lock_guard lock(disk->sqliteMutex);
    std::generate_n(out, count, [] { return static_cast<char>(disk->sqliteRandom()); });
    return count;
}

// No waiting: another connection of the same program continues at once, or never.
int sleepShortly(sqlite3_vfs* vfs, int microseconds) {
    realOf(vfs)->xSleep(realOf(vfs), std::min(microseconds, 100));
    return microseconds;
}

}  // namespace

FaultyDisk::FaultyDisk() {
    sqlite3_initialize();
    sqlite3_vfs* real = sqlite3_vfs_find(nullptr);
    assert(real && "the system has files");
    assert(!disk && "one at a time");
    disk = new DiskState;
    vfs_ = std::make_unique<sqlite3_vfs>(*real);
    vfs_->szOsFile = static_cast<int>(sizeof(File)) + real->szOsFile;
    vfs_->pNext = nullptr;
    vfs_->zName = "faulty";
    vfs_->pAppData = real;
    vfs_->xOpen = openFile;
    vfs_->xDelete = deleteFile;
    vfs_->xRandomness = randomBytes;
    vfs_->xSleep = sleepShortly;
    // These functions use their own VFS.
    vfs_->xAccess = [](sqlite3_vfs* vfs, const char* name, int flags, int* out) {
        return realOf(vfs)->xAccess(realOf(vfs), name, flags, out);
    };
    vfs_->xFullPathname = [](sqlite3_vfs* vfs, const char* name, int bytes, char* out) {
        return realOf(vfs)->xFullPathname(realOf(vfs), name, bytes, out);
    };
    setSystemCalls(real, true);
    sqlite3_vfs_register(vfs_.get(), 1);
}

FaultyDisk::~FaultyDisk() {
    auto* real = static_cast<sqlite3_vfs*>(vfs_->pAppData);
    sqlite3_vfs_unregister(vfs_.get());
    sqlite3_vfs_register(real, 1);
    setSystemCalls(real, false);
    delete std::exchange(disk, nullptr);
}

void FaultyDisk::fail(unsigned kinds, long after, long count, DiskError error) {
    const std::lock_guard lock(disk->mutex);
    disk->counted = disk->failed = 0;
    disk->failFrom = after;
    disk->failUntil = count > LONG_MAX - after ? LONG_MAX : after + count;
    disk->failingKinds = kinds;
    disk->error = error;
}

long FaultyDisk::failures() const {
    const std::lock_guard lock(disk->mutex);
    return disk->failed;
}

void FaultyDisk::stopAfter(DiskStop stop, long after, unsigned seed) {
    const std::lock_guard lock(disk->mutex);
    disk->stop = stop;
    disk->changed = 0;
    disk->stopFrom = after;
    disk->random.seed(seed);
}

bool FaultyDisk::hasStopped() const {
    const std::lock_guard lock(disk->mutex);
    return disk->hasStopped;
}

void FaultyDisk::restart() {
    work();
    const std::lock_guard lock(disk->mutex);
    disk->stopFrom = LONG_MAX;
    disk->unsynced = {};
    if (!std::exchange(disk->hasStopped, false)) return;
    for (const auto& [path, content] : std::exchange(disk->left, {})) {
        std::filesystem::remove(path);
        std::filesystem::remove(path + "-shm");
        if (content) std::ofstream(path, std::ios::binary) << *content;
    }
}

std::uint64_t FaultyDisk::history() const {
    const std::lock_guard lock(disk->mutex);
    return disk->history;
}

void FaultyDisk::seedRandomness(unsigned seed) {
    {
        const std::lock_guard lock(disk->sqliteMutex);
        disk->sqliteRandom.seed(seed);
    }
    sqlite3_randomness(0, nullptr);  // reseeds from the disk
}

}  // namespace terrane::store
