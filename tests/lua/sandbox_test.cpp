// The parts of Lua that scripts can use: no addresses, no clock, no order that varies.
#include "tests/lua/lua_fixture.h"

namespace terrane::lua {
namespace {

// The text that a script ends with as an error.
std::string said(const std::string& text) {
    const std::string message = mistakeOf(text);
    const std::size_t start = message.find(": ");
    return start == std::string::npos ? message : message.substr(start + 2);
}

// Lua's own order depends on a seed that each state takes from the clock and from addresses.
TEST(Sandbox, PairsGoThroughKeysInOrder) {
    const std::string text = R"(
        local t, order = {}, {}
        for i = 1, 40 do t["key " .. i % 37 .. (i * 7919) % 101] = i end
        t[true], t[1.5], t[-3], t[7], t[false] = 1, 1, 1, 1, 1
        for k, v in pairs(t) do order[#order + 1] = tostring(k) end
        error(table.concat(order, ",")))";
    const std::string first = said(text);
    EXPECT_TRUE(first.starts_with("-3,7,1.5,key 0")) << first;
    for (int k = 0; k < 20; ++k) EXPECT_EQ(said(text), first);
}

TEST(Sandbox, PairsAllowsToRemoveAndChange) {
    EXPECT_EQ(said(R"(
        local t, seen = {a = 1, b = 2, c = 3, d = 4}, {}
        for k, v in pairs(t) do
            seen[#seen + 1] = k .. v
            t.b, t.d, t.new = nil, 9, 5
        end
        error(table.concat(seen, ",")))"),
              "a1,c3,d9");
    EXPECT_EQ(said("for k in pairs({}) do error(\"not empty\") end error(\"done\")"), "done");
}

TEST(Sandbox, SortKeepsTheOrderOfEqualItems) {
    const std::string text = R"(
        local t, out = {}, {}
        for i = 1, 300 do t[i] = {key = i * 7 % 10, number = i} end
        table.sort(t, function(a, b) return a.key < b.key end)
        for i = 2, 300 do
            assert(t[i - 1].key < t[i].key or t[i - 1].key == t[i].key and t[i - 1].number < t[i].number)
        end
        local words = {"pear", "Apple", "fig", "apple"}
        table.sort(words)
        error(table.concat(words, ",")))";
    EXPECT_EQ(said(text), "Apple,apple,fig,pear");
}

TEST(Sandbox, ShowsNoAddresses) {
    EXPECT_EQ(said("error(tostring({}) .. tostring(print) .. tostring(g) .. tostring(vec2(1, 2)))"),
              "tablefunctionGeneratorVec2");
    EXPECT_EQ(said("error(string.format(\"%s\", {}))"), "format: argument 2: table has no text");
    EXPECT_EQ(said("error(string.format(\"%5p\", 1))"), "format: %p is not supported");
    EXPECT_EQ(said("error(string.format(\"%d%%p %s\", 3, true))"), "3%p true");
}

TEST(Sandbox, TypesHaveNames) {
    EXPECT_EQ(
        said("error(type(1) .. type(\"\") .. type(g) .. type(vec2(1, 2)) .. type(g:field(\"f\", \"int\")))"),
        "numberstringGeneratorVec2Field");
}

TEST(Sandbox, ListsAndTextsWork) {
    EXPECT_EQ(said(R"(
        local t = {1, 2, 3}
        table.insert(t, 4) table.insert(t, 1, 0) table.remove(t, 2) table.remove(t)
        local a, b, c = table.unpack(t)
        local from, to = ("hello"):find("l")
        error(("ab"):rep(2, "-") .. a .. b .. c .. from .. to .. ("x"):upper() .. #t .. math.floor(2.7)))"),
              "ab-ab02333X32");
}

TEST(Sandbox, StatesShareNothing) {
    EXPECT_EQ(said("shared = 5 string.sub = nil error(\"first\")"), "first");
    EXPECT_EQ(said("error(tostring(shared) .. tostring(string.sub ~= nil))"), "niltrue");
}

// Scripts hold the iterator of pairs and can call it with anything.
TEST(Sandbox, TheIteratorOfPairsIgnoresItsArguments) {
    EXPECT_EQ(said(R"(
        local next = pairs({a = 1, b = 2, c = 3})
        local k1, v1 = next(0x41414141)
        local k2, v2 = next("text", g)
        local k3, v3 = next()
        error(k1 .. v1 .. k2 .. v2 .. k3 .. v3 .. tostring(next(print)) .. tostring(next({}))))"),
              "a1b2c3nilnil");
}

// The sign that C prints differs by processor.
TEST(Sandbox, NaNHasOneName) {
    EXPECT_EQ(said("local n = 0/0 error(tostring(n) .. tostring(-n))"), "nannan");
    EXPECT_EQ(said("local n = 0/0 error(string.format(\"%f %s %g|%5.1f\", n, -n, -n, n))"),
              "nan nan nan|  nan");
    EXPECT_EQ(said("local n = 0/0 error(table.concat({n, -n, 1}, \" \"))"), "nan nan 1");
    EXPECT_EQ(said("error(0/0)"), "nan");
    EXPECT_EQ(said("error(-(0/0))"), "nan");
}

TEST(Sandbox, ErrorsMayBeNumbers) {
    EXPECT_EQ(said("error(5)"), "5");
    EXPECT_EQ(said("error(2.5)"), "2.5");
    EXPECT_EQ(said("error({})"), "error: its message is not a text");
}

// Lua's length of such a list depends on a hash seed.
TEST(Sandbox, ListsWithHolesAreRefused) {
    const char* calls[] = {"table.concat(t)",   "table.insert(t, 1)",
                           "table.remove(t)",   "table.sort(t)",
                           "table.unpack(t)",   "lostSlope(t, 8, 2)",
                           "multiSelect(t, 1)", "g:shape {name = \"s\", blocks = t, voxels = {}}"};
    for (const std::string call : calls) {
        for (const char* list :
             {"{1, nil, 3}", "{[2] = 1}", "{1, 2, [9] = 3}", "{1, nil, nil, nil, 5, x = 1}"}) {
            const std::string mistake = said("local t = " + std::string(list) + " local x = " + call);
            EXPECT_NE(mistake.find("the list has holes"), std::string::npos) << call << list << mistake;
        }
    }
    EXPECT_EQ(said("local t = {1, 2, x = 3, [0] = 4, [-1] = 5, [0.5] = 6} error(table.concat(t))"), "12");
    EXPECT_EQ(said("local t = {1, 2, 3} t[3] = nil error(table.concat(t))"), "12");
}

TEST(Sandbox, BytesOfTexts) {
    EXPECT_EQ(said(R"(
        local s = "hello"
        local function all(...) return table.concat({...}, " ") end
        error(table.concat({all(s:byte()), all(s:byte(2)), all(s:byte(-2, -1)), all(s:byte(1, 9)), all(s:byte(4, 2)),
                            all(s:byte(0)), all(s:byte(-9, 2)), all(s:byte(6)), all((""):byte())}, ",")))"),
              "104,101,108 111,104 101 108 108 111,,,104 101,,");
    EXPECT_EQ(said("local x = ((\"x\"):rep(201)):byte(1, -1)"), "byte: 201 bytes, at most 200 at once");
    EXPECT_EQ(said("error(\"\" .. select(200 == #{((\"x\"):rep(200)):byte(1, -1)}, 1, 0))"), "1");
}

TEST(Sandbox, TextsHaveALimit) {
    EXPECT_EQ(said("error(\"\" .. #(\"x\"):rep(65536))"), "65536");
    EXPECT_NE(said("local s = (\"x\"):rep(65537)").find("longer than 65536 bytes"), std::string::npos);
    EXPECT_NE(said("local s = (\"x\"):rep(40000) s = s .. s").find("64 KiB for a text"), std::string::npos);
    EXPECT_EQ(said("local s = (\"x\"):rep(32768) error(\"\" .. #(s .. s))"), "65536");
}

TEST(Sandbox, StringsAreNoNumbers) {
    EXPECT_NE(said("local x = \"10\" + 1").find("attempt to perform arithmetic on a string value"),
              std::string::npos);
}

}  // namespace
}  // namespace terrane::lua
