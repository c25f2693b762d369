// The names given to editors (assets/lua/terrane.lua) and in docs/lua.md are those that scripts can use.
#include "terrane/lua/state_internal.h"

#include <regex>
#include <set>

#include "tests/lua/lua_fixture.h"

namespace terrane::lua {
namespace {

std::set<std::string> namesOf(const std::string& text, const std::regex& pattern) {
    std::set<std::string> names;
    for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
        names.insert((*it)[1]);
    return names;
}

// Functions, and members of the classes whose names stand before a dot in what scriptFunctions() gives.
std::set<std::string> annotated() {
    const std::string text = readText(std::filesystem::path(TERRANE_SOURCE_DIR) / "assets/lua/terrane.lua");
    std::set<std::string> names = namesOf(text, std::regex("\nfunction ([A-Za-z0-9_.:]+)\\("));
    const std::pair<const char*, const char*> classes[] = {
        {"Pass", "Pass"}, {"Generator", "Generator"}, {"Variable", "Variable"}, {"mathlib", "math"}};
    for (const auto& [type, prefix] : classes) {
        const std::string head = std::string("---@class ") + type + "\n";
        const std::string members =
            text.substr(text.find(head), text.find("= {}", text.find(head)) - text.find(head));
        for (const std::string& member : namesOf(members, std::regex("---@field (\\w+)")))
            names.insert(std::string(prefix) + "." + member);
    }
    names.insert("g");
    return names;
}

TEST(Names, AnnotationsHaveAllAndNothingElse) {
    const std::vector<std::string> functions = scriptFunctions();
    const std::set<std::string> known(functions.begin(), functions.end()), told = annotated();
    for (const std::string& name : known) EXPECT_TRUE(told.contains(name)) << name << " is not annotated";
    for (const std::string& name : told) EXPECT_TRUE(known.contains(name)) << name << " is no function";
    EXPECT_GT(known.size(), 100u);
}

TEST(Names, TheManualHasAll) {
    const std::string manual = readText(std::filesystem::path(TERRANE_SOURCE_DIR) / "docs/lua.md");
    for (const std::string& name : scriptFunctions()) {
        const std::size_t start = name.find_last_of(".:");
        const std::string word = start == std::string::npos ? name : name.substr(start + 1);
        EXPECT_TRUE(std::regex_search(manual, std::regex("\\b" + word + "\\b")))
            << name << " is not in docs/lua.md";
    }
}

}  // namespace
}  // namespace terrane::lua
