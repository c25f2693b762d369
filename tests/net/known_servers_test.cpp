#include "terrane/net/wire/security.h"

#include <gtest/gtest.h>

#include "terrane/base/files.h"
#include "tests/base/temp_folder.h"

namespace terrane::net {
namespace {

TEST(KnownServers, AreTrustedOnFirstUseAndThenByTheirKey) {
    const base::TempFolder folder;
    const auto file = folder / "new folder" / "known.txt";
    EXPECT_TRUE(isKnownOrNew(file, "one:1", "aa").value());
    EXPECT_TRUE(isKnownOrNew(file, "two:2", "bb").value());
    EXPECT_TRUE(isKnownOrNew(file, "one:1", "aa").value());
    EXPECT_FALSE(isKnownOrNew(file, "one:1", "bb").value());
    EXPECT_EQ(base::readFile(file).value(), "one:1 aa\ntwo:2 bb\n");
}

TEST(KnownServers, ALineThatAPersonWroteWithoutItsEndStays) {
    const base::TempFolder folder;
    const auto file = folder / "known.txt";
    ASSERT_TRUE(base::writeFile(file, "one:1 aa"));
    EXPECT_TRUE(isKnownOrNew(file, "two:2", "bb").value());
    EXPECT_EQ(base::readFile(file).value(), "one:1 aa\ntwo:2 bb\n");
}

}  // namespace
}  // namespace terrane::net
