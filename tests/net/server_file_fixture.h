// A server's file in a temporary folder.
#pragma once

#include <gmock/gmock.h>

#include <memory>

#include "terrane/net/server/sqlite_records.h"
#include "tests/base/temp_folder.h"
#include "tests/world/content_blocks.h"

namespace terrane::net {

class ServerFileTest : public testing::Test {
  protected:
    ServerFileTest() { open(); }
    void open(const world::BlockRegistry& blocks = contentBlocks()) {
        file_.reset();
        auto opened = ServerFile::open(folder_ / "w.server.sqlite", blocks);
        ASSERT_TRUE(opened) << opened.error().message;
        file_ = std::move(*opened);
    }
    void flush() { ASSERT_TRUE(file_->flush()); }

    base::TempFolder folder_;
    std::unique_ptr<ServerFile> file_;
};

// The records of a server in such a file.
class RecordsTest : public testing::Test {
  protected:
    RecordsTest() { open(); }
    void open(const world::BlockRegistry& blocks = contentBlocks()) {
        records_.reset();
        auto opened = SqliteRecords::open(folder_ / "w.server.sqlite", blocks);
        ASSERT_TRUE(opened) << opened.error().message;
        records_ = std::move(*opened);
    }
    void flush() { ASSERT_TRUE(records_->flush()); }

    base::TempFolder folder_;
    std::unique_ptr<SqliteRecords> records_;
};

}  // namespace terrane::net
