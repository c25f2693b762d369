#include "terrane/store/sqlite_guard.h"

#include <sqlite3.h>

#include <utility>

namespace terrane::store {

void guardConnection(sqlite3* database) {
    constexpr std::pair<int, int> kSettings[] = {
        {SQLITE_DBCONFIG_DEFENSIVE, 1},      {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
        {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0}, {SQLITE_DBCONFIG_ENABLE_VIEW, 0},
        {SQLITE_DBCONFIG_DQS_DDL, 0},        {SQLITE_DBCONFIG_DQS_DML, 0},
    };
    for (const auto& [setting, value] : kSettings) sqlite3_db_config(database, setting, value, nullptr);
    // Maximum of what saves and the statements of this module need, with a margin. 0 would mean no limit for
    // some of them.
    constexpr std::pair<int, int> kLimits[] = {
        {SQLITE_LIMIT_LENGTH, kMaxValueBytes},
        {SQLITE_LIMIT_SQL_LENGTH, 16384},
        {SQLITE_LIMIT_COLUMN, 32},
        {SQLITE_LIMIT_EXPR_DEPTH, 32},
        {SQLITE_LIMIT_COMPOUND_SELECT, 2},
        {SQLITE_LIMIT_VDBE_OP, 25000},
        {SQLITE_LIMIT_FUNCTION_ARG, 8},
        {SQLITE_LIMIT_ATTACHED, 0},
        {SQLITE_LIMIT_VARIABLE_NUMBER, 16},
        {SQLITE_LIMIT_TRIGGER_DEPTH, 1},
        {SQLITE_LIMIT_WORKER_THREADS, 0},
    };
    for (const auto& [limit, value] : kLimits) sqlite3_limit(database, limit, value);
}

StepLimit::StepLimit(sqlite3* database, int thousands) : database_(database), left_(thousands) {
    constexpr int kStepsBetweenCalls = 1000;
    const auto isOver = [](void* left) { return (*static_cast<int*>(left))-- <= 0 ? 1 : 0; };
    sqlite3_progress_handler(database_, kStepsBetweenCalls, isOver, &left_);
}

StepLimit::~StepLimit() {
    sqlite3_progress_handler(database_, 0, nullptr, nullptr);
}

}  // namespace terrane::store
