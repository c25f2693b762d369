// Malicious scripts (tests/lua/hostile) are stopped: within the limits, with one line. The time they take is
// reported and not tested; the steps that stop them are.
#include <cctype>
#include <chrono>
#include <cstdio>

#include "terrane/lua/state_internal.h"
#include "tests/lua/lua_fixture.h"

namespace terrane::lua {
namespace {

double milliseconds(std::chrono::steady_clock::duration time) {
    return std::chrono::duration<double, std::milli>(time).count();
}

// Files that may be refused without a line: nothing of the script ran.
bool mayHaveNoLine(const std::string& name) {
    return name == "bytecode" || name == "deep_brackets" || name == "many_rings" || name == "kept_blocks" ||
           name == "nested_while" || name == "slow_loops" || name == "slow_drainage" ||
           name == "nested_branches";
}

TEST(HostileScripts, AreStoppedWithOneLine) {
    const std::vector<std::filesystem::path> scripts = scriptsIn("tests/lua/hostile");
    EXPECT_GE(scripts.size(), 50u);
    (void)contentBlocks();
    for (const auto& path : scripts) {
        const std::string name = path.stem();
        const Script script = {readText(path), name + ".lua"};
        const auto start = std::chrono::steady_clock::now();
        const auto graph = recordScript(script, {"hostile", ""}, contentBlocks());
        std::printf("%-24s %6.1f ms\n", name.c_str(), milliseconds(std::chrono::steady_clock::now() - start));
        ASSERT_FALSE(graph) << name;
        const std::string& message = graph.error().message;
        const std::string prefix = mayHaveNoLine(name) ? script.file + ": " : script.file + ":";
        EXPECT_TRUE(message.starts_with(prefix)) << message;
        if (!mayHaveNoLine(name)) {
            EXPECT_TRUE(std::isdigit(static_cast<unsigned char>(message[prefix.size()])) != 0) << message;
        }
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_LT(message.size(), 600u) << message;
    }
}

// Runs a script without a generator that follows from it.
struct ScriptRun {
    explicit ScriptRun(const std::filesystem::path& path, const Limits& limits = {}) {
        gen::GeneratorBuilder builder("hostile", contentBlocks());
        BlockNames names(contentBlocks(), "");
        Recording recording(builder, names);
        recording.budget = Budget(limits);
        const StatePtr state = makeState(recording);
        reason = runScript(state.get(), {readText(path), "x.lua"});
        peakBytes = recording.budget.peakBytes();
        steps = recording.budget.steps();
    }
    std::string reason;
    std::size_t peakBytes;
    std::int64_t steps;
};

TEST(HostileScripts, StayWithinMemory) {
    for (const auto& path : scriptsIn("tests/lua/hostile"))
        EXPECT_LE(ScriptRun(path).peakBytes, Limits{}.memoryBytes) << path;
}

// Comparisons cost no steps, so the clock ends this one. It is read often enough to do so.
TEST(HostileScripts, AreStoppedByTheClock) {
    const auto path = std::filesystem::path(TERRANE_SOURCE_DIR) / "tests/lua/hostile/zero_comparisons.lua";
    const ScriptRun run(path);
    EXPECT_EQ(run.reason, "x.lua:3: runs too long: more than 100 ms");
    EXPECT_LT(run.steps, Limits{}.steps / 10);
}

// Counted alike each time: the clock does not decide.
TEST(HostileScripts, AreStoppedAtTheSameStep) {
    for (const char* name : {"live_at_the_limit", "memory_of_strings", "endless_loop", "evil_comparator",
                             "huge_shapes", "doubled_string", "insert_at_front"}) {
        const auto path =
            std::filesystem::path(TERRANE_SOURCE_DIR) / "tests/lua/hostile" / (std::string(name) + ".lua");
        const Limits limits{.time = std::chrono::hours(1)};
        const ScriptRun first(path, limits), second(path, limits);
        EXPECT_EQ(first.steps, second.steps) << name;
        EXPECT_EQ(first.reason, second.reason) << name;
    }
}

}  // namespace
}  // namespace terrane::lua
