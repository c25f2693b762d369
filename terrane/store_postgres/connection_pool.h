// A pool of connections to one database for many threads. Operations that fail because the server restarts or
// the network breaks are retried with growing pauses.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "terrane/store_postgres/connection.h"

namespace terrane::store_postgres {

// Pauses between attempts, which double, and the total time of attempts: `total` for writing, which a queue
// retries later, `reading` for reads, whose result is needed now.
struct RetryTimes {
    std::chrono::milliseconds first{50}, longest{2000}, total{30000}, reading = total;
};

class ConnectionPool {
  public:
    explicit ConnectionPool(Address address, RetryTimes times = {})
        : address_(std::move(address)), times_(times) {}

    const Address& address() const { return address_; }

    // Runs `use`, which reads, with its own connection, again while isPassing(). Any thread.
    template <class T>
    [[nodiscard]] base::Result<T> run(const std::function<base::Result<T>(Connection&)>& use) {
        return retryFor<T>(times_.reading, [&]() -> base::Result<T> {
            auto connection = TERRANE_TRY(take());
            auto result = use(connection);
            giveBack(std::move(connection));
            return result;
        });
    }

    // Retries an attempt to write, which has its own connection.
    template <class T>
    [[nodiscard]] base::Result<T> retry(const std::function<base::Result<T>()>& attempt) {
        return retryFor<T>(times_.total, attempt);
    }

  private:
    template <class T>
    base::Result<T> retryFor(std::chrono::milliseconds total,
                             const std::function<base::Result<T>()>& attempt) {
        const auto end = std::chrono::steady_clock::now() + total;
        for (auto pause = times_.first;; pause = std::min(2 * pause, times_.longest)) {
            auto result = attempt();
            if (result || !isPassing(result.error()) || std::chrono::steady_clock::now() + pause > end)
                return result;
            std::this_thread::sleep_for(pause);
        }
    }

    base::Result<Connection> take();
    void giveBack(Connection connection);  // a broken one drops the idle ones, which are as old

    Address address_;
    RetryTimes times_;
    std::mutex mutex_;
    std::vector<Connection> idle_;
};

}  // namespace terrane::store_postgres
