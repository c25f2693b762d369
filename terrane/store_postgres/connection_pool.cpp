#include "terrane/store_postgres/connection_pool.h"

#include <utility>

namespace terrane::store_postgres {

base::Result<Connection> ConnectionPool::take() {
    {
        const std::lock_guard lock(mutex_);
        if (!idle_.empty()) {
            Connection connection = std::move(idle_.back());
            idle_.pop_back();
            return connection;
        }
    }
    return Connection::open(address_);
}

void ConnectionPool::giveBack(Connection connection) {
    const std::lock_guard lock(mutex_);
    if (connection.isUsable())
        idle_.push_back(std::move(connection));
    else
        idle_.clear();
}

}  // namespace terrane::store_postgres
