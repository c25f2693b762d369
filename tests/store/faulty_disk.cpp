#include "tests/store/faulty_disk.h"

#include <sqlite3.h>

#include <atomic>
#include <cassert>

namespace terrane::store {
namespace {

// One disk at a time: SQLite's callbacks know only files.
std::atomic<unsigned> failingKinds = 0;
std::atomic<long> counted = 0, failFrom = 0, failUntil = 0;

bool fails(DiskOperation kind) {
    if ((failingKinds & kind) == 0) return false;
    const long number = counted++;
    return number >= failFrom && number < failUntil;
}

struct File {
    sqlite3_file base;
    sqlite3_file* real;  // behind this one in memory
};

sqlite3_file* realOf(sqlite3_file* file) {
    return reinterpret_cast<File*>(file)->real;
}
sqlite3_vfs* realOf(sqlite3_vfs* vfs) {
    return static_cast<sqlite3_vfs*>(vfs->pAppData);
}

template <class Run>
int unlessFailing(DiskOperation kind, int code, Run run) {
    return fails(kind) ? code : run();
}

const sqlite3_io_methods kMethods = {
    .iVersion = 2,
    .xClose = [](sqlite3_file* f) { return realOf(f)->pMethods->xClose(realOf(f)); },
    .xRead =
        [](sqlite3_file* f, void* to, int bytes, sqlite3_int64 at) {
            return unlessFailing(kDiskRead, SQLITE_IOERR_READ,
                                 [&] { return realOf(f)->pMethods->xRead(realOf(f), to, bytes, at); });
        },
    .xWrite =
        [](sqlite3_file* f, const void* from, int bytes, sqlite3_int64 at) {
            return unlessFailing(kDiskWrite, SQLITE_IOERR_WRITE,
                                 [&] { return realOf(f)->pMethods->xWrite(realOf(f), from, bytes, at); });
        },
    .xTruncate =
        [](sqlite3_file* f, sqlite3_int64 size) {
            return unlessFailing(kDiskTruncate, SQLITE_IOERR_TRUNCATE,
                                 [&] { return realOf(f)->pMethods->xTruncate(realOf(f), size); });
        },
    .xSync =
        [](sqlite3_file* f, int flags) {
            return unlessFailing(kDiskSync, SQLITE_IOERR_FSYNC,
                                 [&] { return realOf(f)->pMethods->xSync(realOf(f), flags); });
        },
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
            return unlessFailing(kDiskLock, SQLITE_IOERR_SHMLOCK, [&] {
                return realOf(f)->pMethods->xShmLock(realOf(f), first, count, flags);
            });
        },
    .xShmBarrier = [](sqlite3_file* f) { realOf(f)->pMethods->xShmBarrier(realOf(f)); },
    .xShmUnmap = [](sqlite3_file* f,
                    int isDeleted) { return realOf(f)->pMethods->xShmUnmap(realOf(f), isDeleted); },
    .xFetch = nullptr,
    .xUnfetch = nullptr,
};

int openFile(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* outFlags) {
    auto* opened = reinterpret_cast<File*>(file);
    opened->real = reinterpret_cast<sqlite3_file*>(opened + 1);
    opened->base.pMethods = nullptr;  // nothing to close
    if (fails(kDiskOpen)) return SQLITE_CANTOPEN;
    const int code = realOf(vfs)->xOpen(realOf(vfs), name, opened->real, flags, outFlags);
    if (code == SQLITE_OK) opened->base.pMethods = &kMethods;
    return code;
}

int deleteFile(sqlite3_vfs* vfs, const char* name, int syncsFolder) {
    return unlessFailing(kDiskDelete, SQLITE_IOERR_DELETE,
                         [&] { return realOf(vfs)->xDelete(realOf(vfs), name, syncsFolder); });
}

}  // namespace

FaultyDisk::FaultyDisk() {
    sqlite3_initialize();
    sqlite3_vfs* real = sqlite3_vfs_find(nullptr);
    assert(real && "the system has files");
    vfs_ = std::make_unique<sqlite3_vfs>(*real);
    vfs_->szOsFile = static_cast<int>(sizeof(File)) + real->szOsFile;
    vfs_->pNext = nullptr;
    vfs_->zName = "faulty";
    vfs_->pAppData = real;
    vfs_->xOpen = openFile;
    vfs_->xDelete = deleteFile;
    // These look at their own VFS.
    vfs_->xAccess = [](sqlite3_vfs* vfs, const char* name, int flags, int* out) {
        return realOf(vfs)->xAccess(realOf(vfs), name, flags, out);
    };
    vfs_->xFullPathname = [](sqlite3_vfs* vfs, const char* name, int bytes, char* out) {
        return realOf(vfs)->xFullPathname(realOf(vfs), name, bytes, out);
    };
    work();
    sqlite3_vfs_register(vfs_.get(), 1);
}

FaultyDisk::~FaultyDisk() {
    sqlite3_vfs_unregister(vfs_.get());
    sqlite3_vfs_register(static_cast<sqlite3_vfs*>(vfs_->pAppData), 1);
}

void FaultyDisk::fail(unsigned kinds, long after, long count) {
    failingKinds = 0;
    counted = 0;
    failFrom = after;
    failUntil = count == LONG_MAX ? LONG_MAX : after + count;
    failingKinds = kinds;
}

long FaultyDisk::operations() const {
    return counted;
}

}  // namespace terrane::store
