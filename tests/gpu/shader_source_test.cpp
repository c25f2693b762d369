#include "terrane/gpu/shader_loader.h"

#include <gtest/gtest.h>

#include <map>

namespace terrane::gpu {
namespace {

using Files = std::map<std::string, std::string, std::less<>>;

base::Result<ShaderSource> expand(const Files& files, std::string_view name = "main") {
    return expandIncludes(name, [&files](std::string_view path) -> std::optional<std::string> {
        const auto found = files.find(path);
        if (found == files.end()) return std::nullopt;
        return found->second;
    });
}

std::string expandedText(const Files& files) {
    const base::Result<ShaderSource> source = expand(files);
    EXPECT_TRUE(source) << source.error().message;
    return source ? source->text : std::string();
}

std::string errorOf(const Files& files, std::string_view name = "main") {
    const base::Result<ShaderSource> source = expand(files, name);
    return source ? "no error" : source.error().message;
}

TEST(ShaderSourceTest, textWithoutIncludesStays) {
    const base::Result<ShaderSource> source = expand({{"main", "a\n#define B 1\n\n  c"}});
    ASSERT_TRUE(source);
    EXPECT_EQ(source->text, "#line 1 0\na\n#define B 1\n\n  c\n");
    EXPECT_EQ(source->files, std::vector<std::string>{"main"});
}

TEST(ShaderSourceTest, includesAreNumberedAndLinesGoOn) {
    const Files files = {{"main", "a\n#include \"x/one.h\"\nb\n # include\t\"two.h\" // why\nc\n"},
                         {"x/one.h", "one\n#include \"three.h\"\nmore\n"},
                         {"two.h", "two"},
                         {"three.h", "three\n"}};
    const base::Result<ShaderSource> source = expand(files);
    ASSERT_TRUE(source) << source.error().message;
    EXPECT_EQ(source->text,
              "#line 1 0\na\n"
              "#line 1 1\none\n#line 1 2\nthree\n#line 3 1\nmore\n#line 3 0\nb\n"
              "#line 1 3\ntwo\n#line 5 0\nc\n");
    EXPECT_EQ(source->files, (std::vector<std::string>{"main", "x/one.h", "three.h", "two.h"}));
}

TEST(ShaderSourceTest, eachFileComesOnce) {
    const Files files = {{"main", "#include \"a\"\n#include \"b\"\n#include \"a\"\nend\n"},
                         {"a", "A\n#include \"main\"\n"},
                         {"b", "#include \"a\"\nB\n"}};
    EXPECT_EQ(expandedText(files),
              "#line 1 0\n#line 1 1\nA\n\n#line 2 0\n#line 1 2\n\nB\n#line 3 0\n\nend\n");
}

TEST(ShaderSourceTest, whatIsForCppIsLeftOut) {
    const Files files = {
        {"main",
         "#ifdef __cplusplus\n#include <cstdint>\n#include \"none.h\"\nint a = 1'000;\n#else\n"
         "#include \"glsl\"\nb\n#endif\nc\n"},
        {"glsl", "G\n"}};
    EXPECT_EQ(expandedText(files),
              "#line 1 0\n#ifdef __cplusplus\n\n\n\n#else\n#line 1 1\nG\n#line 7 0\nb\n#endif\nc\n");
}

TEST(ShaderSourceTest, ifndefCppIsTheOtherWayRound) {
    const Files files = {
        {"main", "#ifndef __cplusplus\n#include \"glsl\"\n#else\n#include <vector>\n#endif\n"},
        {"glsl", "G\n"}};
    EXPECT_EQ(expandedText(files),
              "#line 1 0\n#ifndef __cplusplus\n#line 1 1\nG\n#line 3 0\n#else\n\n#endif\n");
}

TEST(ShaderSourceTest, nestedConditionsOfCppKeepTheirEnds) {
    const Files files = {
        {"main",
         "#ifdef __cplusplus\n#if X\n#include <a>\n#else\n#include <b>\n#endif\n#include <c>\n#endif\nd\n"}};
    EXPECT_EQ(expandedText(files), "#line 1 0\n#ifdef __cplusplus\n#if X\n\n#else\n\n#endif\n\n#endif\nd\n");
}

TEST(ShaderSourceTest, otherConditionsAreNotJudged) {
    const Files files = {{"main", "#ifndef GUARD\n#if FOO\n#include \"a\"\n#elif BAR\nb\n#endif\n#endif\n"},
                         {"a", "A\n"}};
    EXPECT_EQ(expandedText(files),
              "#line 1 0\n#ifndef GUARD\n#if FOO\n#line 1 1\nA\n#line 4 0\n#elif BAR\nb\n#endif\n#endif\n");
}

TEST(ShaderSourceTest, commentsAreNotDirectives) {
    EXPECT_EQ(
        expandedText({{"main", "// #include \"x\"\n/* a\n#include \"y\"\n*/ b // /*\nc /* d */ /* e\n*/\n"}}),
        "#line 1 0\n// #include \"x\"\n/* a\n#include \"y\"\n*/ b // /*\nc /* d */ /* e\n*/\n");
    EXPECT_EQ(errorOf({{"main", "// /*\n#include \"y\"\n"}}), "main:2: #include: no file y");
}

TEST(ShaderSourceTest, errorsNameTheIncluderAndItsLine) {
    EXPECT_EQ(errorOf({}, "sky.frag.glsl"), "sky.frag.glsl: no such shader");
    const Files missing = {{"main", "a\n#include \"b.h\"\n"}, {"b.h", "\n\n#include \"c.h\"\n"}};
    EXPECT_EQ(errorOf(missing), "b.h:3: #include: no file c.h");
    EXPECT_EQ(errorOf({{"main", "#include <vector>\n"}}),
              "main:1: #include: expected a path in double quotes");
    EXPECT_EQ(errorOf({{"main", "\n#include \"open\n"}}),
              "main:2: #include: expected a path in double quotes");
    EXPECT_EQ(errorOf({{"main", "#include"}}), "main:1: #include: expected a path in double quotes");
}

TEST(ShaderSourceTest, headerHoldsVersionAndDefines) {
    EXPECT_EQ(shaderHeader(ShaderStage::Fragment, {{"SAMPLES", "4"}, {"FOG", "1"}}),
              "#version 450 core\n#define SAMPLES 4\n#define FOG 1\n");
    EXPECT_EQ(shaderHeader(ShaderStage::Vertex, {}),
              "#version 450 core\n#extension GL_ARB_shader_draw_parameters : require\n");
    EXPECT_EQ(shaderHeader(ShaderStage::Compute, {}), "#version 450 core\n");
}

TEST(ShaderSourceTest, logsNameTheFiles) {
    const std::vector<std::string> files = {"sky.frag.glsl", "quad.h"};
    EXPECT_EQ(replaceSourceNumbers("0(12) : error C1008: undefined\n", files),
              "sky.frag.glsl(12) : error C1008: undefined\n");
    EXPECT_EQ(replaceSourceNumbers("1:12(5): error: `x'\n0:3(1): warning", files),
              "quad.h:12(5): error: `x'\nsky.frag.glsl:3(1): warning");
    EXPECT_EQ(replaceSourceNumbers("ERROR: 1:7: '' : syntax", files), "ERROR: quad.h:7: '' : syntax");
    EXPECT_EQ(replaceSourceNumbers("2:1: not ours\n3 errors\n\n10", files), "2:1: not ours\n3 errors\n\n10");
    EXPECT_EQ(replaceSourceNumbers("", files), "");
}

}  // namespace
}  // namespace terrane::gpu
