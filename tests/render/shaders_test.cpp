// Variants of every shader, through the reference compiler and through the driver: all of them where
// TERRANE_DEPTH=all, else so many that each pair of options occurs.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>

#include "terrane/gpu/program.h"
#include "terrane/render/frame/variants.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/gpu/scratch_folder.h"
#include "tests/render/content.h"
#include "tests/support/depth.h"

namespace terrane::render {
namespace {

const std::vector<gpu::ShaderDefines> kPlain = {{}};

bool has(const gpu::ShaderDefines& defines, const char* name, const char* value) {
    return std::ranges::find(defines, std::pair<std::string, std::string>(name, value)) != defines.end();
}

// The pairs of options that a variant has: names and values. An option is also a pair with itself.
using Pair = std::array<std::string, 4>;
std::vector<Pair> pairsOf(const gpu::ShaderDefines& defines) {
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < defines.size(); ++a)
        for (std::size_t b = a; b < defines.size(); ++b)
            pairs.push_back({defines[a].first, defines[a].second, defines[b].first, defines[b].second});
    return pairs;
}

// The variant with most pairs that no chosen one has, again and again until all pairs of all variants occur.
std::vector<gpu::ShaderDefines> coveringPairs(const std::vector<gpu::ShaderDefines>& variants) {
    std::set<Pair> missing;
    for (const gpu::ShaderDefines& variant : variants)
        for (Pair& pair : pairsOf(variant)) missing.insert(std::move(pair));
    std::vector<gpu::ShaderDefines> chosen;
    while (!missing.empty()) {
        const auto news = [&](const gpu::ShaderDefines& variant) {
            return std::ranges::count_if(pairsOf(variant),
                                         [&](const Pair& p) { return missing.contains(p); });
        };
        chosen.push_back(*std::ranges::max_element(variants, {}, news));
        for (const Pair& pair : pairsOf(chosen.back())) missing.erase(pair);
    }
    return chosen;
}

std::vector<gpu::ShaderDefines> variantsOf(std::string_view path) {
    constexpr std::string_view kFolder = "terrane/render/", kEnding = ".glsl";
    std::vector<gpu::ShaderDefines> variants = kPlain;
    if (path.ends_with("/mesh.comp.glsl"))
        variants = {{{"WRITES_QUADS", "0"}}, {{"WRITES_QUADS", "1"}}};
    else if (path.starts_with(kFolder) && path.ends_with(kEnding))
        variants = allVariants(path.substr(kFolder.size(), path.size() - kFolder.size() - kEnding.size()));
    return testsAll() ? variants : coveringPairs(variants);
}

std::string named(const gpu::ShaderDefines& defines) {
    std::string names;
    for (const auto& [name, value] : defines) names += ',' + name + '=' + value;
    return names;
}

// Macros in #if conditions of the text that nothing in it defines: a list above lacks them. The language
// would take them as 0 or as an error.
std::string undefinedMacros(const std::string& text) {
    static const std::regex condition("\n#(?:el)?if ([^\n]*)"), macro("[A-Z][A-Z0-9_]*");
    std::string names;
    for (std::sregex_iterator line(text.begin(), text.end(), condition), end; line != end; ++line) {
        const std::string asked = (*line)[1];
        for (std::sregex_iterator name(asked.begin(), asked.end(), macro); name != end; ++name) {
            if (text.find("#define " + name->str() + ' ') == std::string::npos) names += ' ' + name->str();
        }
    }
    return names;
}

struct Stage {
    std::string_view ending, option;
    gpu::ShaderStage stage;
};
constexpr std::array kStages = {Stage{".vert.glsl", "vert", gpu::ShaderStage::Vertex},
                                Stage{".frag.glsl", "frag", gpu::ShaderStage::Fragment},
                                Stage{".comp.glsl", "comp", gpu::ShaderStage::Compute}};

const Stage* stageOf(std::string_view name) {
    for (const Stage& stage : kStages) {
        if (name.ends_with(stage.ending)) return &stage;
    }
    return nullptr;  // included by others
}

struct Output {
    int status = 0;
    std::string text;
};

Output run(const std::string& command) {
    Output output;
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (!pipe) return {-1, "the shell does not start"};
    std::array<char, 4096> part;
    while (const std::size_t count = std::fread(part.data(), 1, part.size(), pipe)) {
        output.text.append(part.data(), count);
    }
    output.status = pclose(pipe);
    return output;
}

// Errors of the reference compiler for shaders, given by name; empty if it accepts all. Each run reads the
// language's functions first, which takes longer than dozens of shaders. A command that names more than some
// hundred is too long for the shell.
std::string complaints(const gpu::ScratchFolder& folder, const Stage& stage,
                       const std::map<std::string, std::string>& texts) {
    constexpr std::size_t kMostOfARun = 100;
    const std::string compiler = "glslangValidator -S " + std::string(stage.option);
    std::string command = compiler, said;
    std::size_t named = 0;
    for (const auto& [name, text] : texts) {
        folder.write(name + ".glsl", text);
        command += " '" + (folder.path() / (name + ".glsl")).string() + "'";
        if (++named % kMostOfARun != 0 && named < texts.size()) continue;
        const Output output = run(command);
        if (output.status != 0) said += output.text + "(status " + std::to_string(output.status) + ")";
        command = compiler;
    }
    return said;
}

class Shaders : public testing::Test {
  protected:
    void SetUp() override {
        if (run("glslangValidator --version").status != 0) {
            GTEST_SKIP() << "1 test skipped: glslangValidator is not installed (Debian: glslang-tools)";
        }
    }
    const gpu::ScratchFolder folder_;
};

TEST_F(Shaders, ReferenceCompilerAcceptsEveryVariant) {
    int checked = 0;
    for (const base::EmbeddedFile& file : embedded::shaders()) {
        const Stage* stage = stageOf(file.path);
        if (!stage) continue;
        std::map<std::string, std::string> texts;
        for (const gpu::ShaderDefines& defines : variantsOf(file.path)) {
            const auto source = contentShaders().load(file.path, stage->stage, defines);
            ASSERT_TRUE(source) << source.error().message;
            EXPECT_EQ(undefinedMacros(source->text), "") << file.path << named(defines);
            texts["variant" + named(defines)] = source->text;
            ++checked;
        }
        EXPECT_EQ(complaints(folder_, *stage, texts), "") << file.path;
    }
    EXPECT_GE(checked, atDepth(80, 400));
}

TEST(ShaderPairs, AllOccurInFewVariants) {
    const auto all = allVariants("shading/shade.frag");
    const auto chosen = coveringPairs(all);
    EXPECT_LE(chosen.size(), all.size() / 8);
    std::set<Pair> wanted, found;
    for (const auto& variant : all)
        for (const Pair& pair : pairsOf(variant)) wanted.insert(pair);
    for (const auto& variant : chosen)
        for (const Pair& pair : pairsOf(variant)) found.insert(pair);
    EXPECT_EQ(found, wanted);
}

TEST_F(Shaders, ReferenceCompilerRefusesMistakes) {
    constexpr const char* kRight = "#version 450 core\nvoid main() {}\n";
    constexpr const char* kWrong = "#version 450 core\nvoid main() { undeclared = 1; }\n";
    EXPECT_EQ(complaints(folder_, kStages[1], {{"a", kRight}, {"b", kRight}}), "");
    EXPECT_NE(complaints(folder_, kStages[1], {{"a", kWrong}, {"b", kRight}}), "");
    EXPECT_NE(complaints(folder_, kStages[1], {{"a", kRight}, {"b", kWrong}}), "");
    const auto source =
        contentShaders().load("terrane/render/quads/gbuffer.frag.glsl", gpu::ShaderStage::Fragment,
                              {{"ALPHA_CLASS", "1"}, {"MSAA_SAMPLES", "1"}, {"SMOOTH", "1"}});
    ASSERT_TRUE(source);
    EXPECT_NE(complaints(folder_, kStages[0], {{"a", source->text}}), "") << "another stage";
}

TEST(ShaderMacros, ThoseThatNobodyDefinesAreFound) {
    EXPECT_EQ(undefinedMacros("\n#define KNOWN 1\n#if KNOWN == 1 && OTHER > 1\n#elif !THIRD\n#endif\n"),
              " OTHER THIRD");
    for (const base::EmbeddedFile& file : embedded::shaders()) {
        if (!file.path.ends_with("/shade.frag.glsl")) continue;
        const auto source =
            contentShaders().load(file.path, gpu::ShaderStage::Fragment, {{"MSAA_SAMPLES", "1"}});
        ASSERT_TRUE(source);
        EXPECT_NE(undefinedMacros(source->text).find("OVER_SKY"), std::string::npos);
    }
}

class ShaderPrograms : public gpu::GlTest {};

// Some have one of the same name. Quads have a vertex shader variant for each PASS but that of rays, which
// cover the screen; layers are shaded over quads or over the screen.
std::string vertexShaderFor(std::string_view path, const gpu::ShaderDefines& defines) {
    std::string own(path.substr(0, path.rfind(".frag")));
    own += ".vert.glsl";
    if (std::ranges::find(embedded::shaders(), own, &base::EmbeddedFile::path) != embedded::shaders().end())
        return own;
    if (path.find("/figure") != std::string_view::npos) return "terrane/render/figures/figure.vert.glsl";
    const bool isOfQuads = std::ranges::any_of(
        defines, [](const auto& d) { return d.first == "PASS" && d.second != std::to_string(PASS_RAYS); });
    return isOfQuads && !has(defines, "QUADS", "0") ? "terrane/render/quads/quad.vert.glsl"
                                                    : "terrane/render/frame/fullscreen.vert.glsl";
}

// The stages must fit each other too, which the reference compiler does not check.
TEST_F(ShaderPrograms, EveryPairLinksOnTheDriver) {
    for (const base::EmbeddedFile& file : embedded::shaders()) {
        const Stage* stage = stageOf(file.path);
        if (!stage || stage->stage == gpu::ShaderStage::Vertex) continue;
        for (const gpu::ShaderDefines& defines : variantsOf(file.path)) {
            const auto program =
                stage->stage == gpu::ShaderStage::Compute
                    ? gpu::Program::compute(contentShaders(), file.path, defines, "test")
                    : gpu::Program::graphics(contentShaders(), vertexShaderFor(file.path, defines), file.path,
                                             defines, "test");
            EXPECT_TRUE(program) << file.path << named(defines) << ": "
                                 << (program ? "" : program.error().message);
        }
    }
}

}  // namespace
}  // namespace terrane::render
