#include "terrane/web/map_parts.h"

#include <gtest/gtest.h>

#include "terrane/base/files.h"
#include "tests/base/temp_folder.h"

namespace terrane::web {
namespace {

TEST(WebAddressFrom, TakesAPortAndAnAddress) {
    const auto port = webAddressFrom("8080"), v4 = webAddressFrom("0.0.0.0:80"),
               v6 = webAddressFrom("[::1]:8080");
    ASSERT_TRUE(port && v4 && v6);
    EXPECT_EQ(urlOf(*port, 8080), "http://127.0.0.1:8080/");
    EXPECT_EQ(urlOf(*v4, 80), "http://localhost:80/");
    EXPECT_EQ(urlOf(*v6, 8080), "http://[::1]:8080/");
    for (const char* text : {"", "x", "65536", "::1:80", "[::1]", ":80", "nowhere:80"})
        EXPECT_FALSE(webAddressFrom(text)) << text;
}

TEST(TitleOf, IsTheNameWithoutFoldersAndPasswords) {
    EXPECT_EQ(titleOf(""), "Terrane");
    EXPECT_EQ(titleOf("a/home.sqlite"), "home");
    EXPECT_EQ(titleOf("postgresql://me:secret@host/isles?sslmode=require"), "isles");
    EXPECT_EQ(titleOf("postgresql://me:secret@host"), "Terrane");
}

TEST(ReadPlaceFile, NumbersPlacesWithoutAName) {
    const base::TempFolder folder;
    ASSERT_TRUE(base::writeFile(folder / "places.txt", "1 2 3 0 0 Home\n\n4 5 6 90 0\r\n"));
    const auto places = readPlaceFile(folder / "places.txt");
    ASSERT_TRUE(places) << places.error().message;
    ASSERT_EQ(places->size(), 2u);
    EXPECT_EQ((*places)[0].name, "Home");
    EXPECT_EQ((*places)[1].name, "1");
    EXPECT_EQ(namedPlaces(*places)[1].x, 4);
    EXPECT_TRUE(readPlaceFile("").value().empty());
    ASSERT_TRUE(base::writeFile(folder / "places.txt", "1 2 3 0 0 Home\nhere\n"));
    const auto wrong = readPlaceFile(folder / "places.txt");
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.error().message.find("places.txt:2: "), std::string::npos) << wrong.error().message;
}

}  // namespace
}  // namespace terrane::web
