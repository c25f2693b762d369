// Makes writing fail, as on a full disk, without the rights of root.
#pragma once

#include <cstdint>

#ifndef _WIN32
#include <sys/resource.h>

#include <csignal>
#endif

namespace terrane::base {

// No file can grow beyond the limit while an object exists. Tests skip themselves where kWorks is false:
// Windows has no such limit.
class FileSizeLimit {
  public:
#ifdef _WIN32
    static constexpr bool kWorks = false;
    explicit FileSizeLimit(std::uint64_t) {}
    ~FileSizeLimit() {}
#else
    static constexpr bool kWorks = true;
    explicit FileSizeLimit(std::uint64_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    void (*handler_)(int);

  public:
#endif
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
};

}  // namespace terrane::base
