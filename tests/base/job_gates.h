// Gates and busy workers for the tests of jobs.
#pragma once

#include <condition_variable>
#include <mutex>

#include "terrane/base/job_system.h"

namespace terrane::base {

// Opens once; waiting threads block until then.
class Gate {
  public:
    void open() {
        {
            const std::lock_guard lock(mutex_);
            isOpen_ = true;
        }
        opened_.notify_all();
    }
    void wait() {
        std::unique_lock lock(mutex_);
        opened_.wait(lock, [&] { return isOpen_; });
    }

  private:
    std::mutex mutex_;
    std::condition_variable opened_;
    bool isOpen_ = false;
};

// Occupies one worker from construction until release.
class Blocker {
  public:
    explicit Blocker(JobSystem& jobs) {
        handle_ = jobs.submit(0, [this] {
            started_.open();
            released_.wait();
        });
        started_.wait();
    }
    ~Blocker() { release(); }
    void release() {
        released_.open();
        handle_.wait();
    }

  private:
    Gate started_;
    Gate released_;
    JobHandle handle_;
};

}  // namespace terrane::base
