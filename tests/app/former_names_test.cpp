#include "apps/terrane/options.h"

#include <gtest/gtest.h>

namespace terrane::app {
namespace {

using Arguments = std::vector<std::string>;

Arguments named(std::initializer_list<const char*> arguments) {
    return withCurrentNames({arguments.begin(), arguments.size()});
}

TEST(FormerNames, CommandsAndFlagsAreReplaced) {
    EXPECT_EQ(named({"terrane", "fly", "--for", "3", "--atmosphere=off", "-o", "fly"}),
              (Arguments{"terrane", "flight-bench", "--duration", "3", "--distance-fog=off", "-o", "fly"}));
    EXPECT_EQ(named({"terrane", "--position", "2", "--save-game", "a"}),
              (Arguments{"terrane", "--bookmark", "2", "--world", "a"}));
}

TEST(FormerNames, AllElseStays) {
    const Arguments all = {"terrane", "render", "for", "--form", "--merging", "none", "--", "--", "--=x", ""};
    EXPECT_EQ(named({"terrane", "render", "for", "--form", "--merging", "none", "--", "--", "--=x", ""}),
              all);
    EXPECT_EQ(named({}), Arguments{});
}

TEST(FormerNames, ValuesAreReplaced) {
    EXPECT_EQ(currentValue("aggregation"), "merging");
    EXPECT_EQ(currentValue("color"), "color");
}

}  // namespace
}  // namespace terrane::app
