// Every variant of every shader, through the reference compiler and through the driver. A shader that is new
// is found by its name; one that has variants is listed here.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "terrane/gpu/program.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/gpu/scratch_folder.h"
#include "tests/render/content.h"

namespace terrane::render {
namespace {

const std::vector<gpu::ShaderDefines> kPlain = {{}};

// All combinations of values.
using Values = std::vector<std::pair<std::string, std::vector<std::string>>>;
std::vector<gpu::ShaderDefines> combined(const Values& values) {
    std::vector<gpu::ShaderDefines> all = kPlain;
    for (const auto& [name, choices] : values) {
        std::vector<gpu::ShaderDefines> more;
        for (const gpu::ShaderDefines& defines : all) {
            for (const std::string& choice : choices) {
                more.push_back(defines);
                more.back().emplace_back(name, choice);
            }
        }
        all = std::move(more);
    }
    return all;
}

// By the name in its folder, with the stage.
const std::map<std::string, Values>& variantValues() {
    static const std::map<std::string, Values> values = {
        {"mesh.comp", {{"WRITES_QUADS", {"0", "1"}}}},
        {"quad.vert", {{"PASS", {"0", "1", "2"}}, {"ALPHA_CLASS", {"0", "1", "2"}}}},
        {"gbuffer.frag",
         {{"PASS", {"0"}}, {"ALPHA_CLASS", {"0", "1"}}, {"SAMPLES", {"1", "4"}}, {"SMOOTH", {"0", "1"}}}},
        {"shadow.frag", {{"PASS", {"2"}}, {"ALPHA_CLASS", {"0", "1"}}}},
        {"layer.frag",
         {{"PASS", {"1"}}, {"ALPHA_CLASS", {"2"}}, {"NEXT", {"0", "1"}}, {"SAMPLES", {"1", "4"}}}},
        {"layers.frag",
         {{"SAMPLES", {"1", "4"}},
          {"LAYERS", {"1", "2", "3"}},
          {"SHADOW", {"0", "1"}},
          {"LIGHT_SMOOTH", {"0", "1"}},
          {"QUADS", {"0"}}}},
        {"sky.frag", {{"SAMPLES", {"1", "4"}}, {"CLOUDS", {"0", "1"}}}},
        {"hole_fill.frag", {{"SAMPLES", {"1", "4"}}}},
        {"far_blur.frag", {{"AXIS", {"0", "1"}}, {"SAMPLES", {"1", "4"}}}},
        {"ambient_occlusion.frag", {{"SAMPLES", {"1", "4"}}}},
        {"occlusion_blur.frag", {{"AXIS", {"0", "1"}}, {"SAMPLES", {"1", "4"}}}},
        {"final.frag",
         {{"SAMPLES", {"1", "4"}},
          {"FAR_BLUR", {"0", "1"}},
          {"GOD_RAYS", {"0", "1"}},
          {"RAW_OCCLUSION", {"0", "1"}}}},
        {"depth_pyramid.comp", {{"LEVEL_0", {"0", "1"}}, {"SAMPLES", {"1", "4"}}}},
        {"debug_view.frag", {{"SAMPLES", {"1", "4"}}, {"LIGHT_SMOOTH", {"0", "1"}}}},
        {"shade.frag",
         {{"SAMPLES", {"1", "4"}},
          {"PER_SAMPLE", {"0", "1"}},
          {"LIGHT_SMOOTH", {"0", "1"}},
          {"SHADOW", {"0", "1"}},
          {"OCCLUSION", {"0", "1"}}}},
    };
    return values;
}

std::vector<gpu::ShaderDefines> variantsOf(std::string_view path) {
    for (const auto& [name, values] : variantValues()) {
        if (path.ends_with("/" + name + ".glsl")) return combined(values);
    }
    return kPlain;
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

// What the reference compiler says against a shader; empty where it accepts it.
std::string complaints(const gpu::ScratchFolder& folder, const Stage& stage, std::string_view text) {
    folder.write("shader.glsl", text);
    const std::string file = (folder.path() / "shader.glsl").string();
    const Output output = run("glslangValidator -S " + std::string(stage.option) + " '" + file + "'");
    return output.status == 0 ? "" : output.text + "(status " + std::to_string(output.status) + ")";
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
        for (const gpu::ShaderDefines& defines : variantsOf(file.path)) {
            const auto source = contentShaders().load(file.path, stage->stage, defines);
            ASSERT_TRUE(source) << source.error().message;
            EXPECT_EQ(complaints(folder_, *stage, source->text), "")
                << file.path << ' ' << (defines.empty() ? "" : defines[0].first + '=' + defines[0].second);
            ++checked;
        }
    }
    EXPECT_GE(checked, 40);
}

TEST_F(Shaders, ReferenceCompilerRefusesMistakes) {
    EXPECT_NE(complaints(folder_, kStages[1], "#version 450 core\nvoid main() { undeclared = 1; }\n"), "");
    const auto source = contentShaders().load("terrane/render/gbuffer.frag.glsl", gpu::ShaderStage::Fragment,
                                              {{"ALPHA_CLASS", "1"}, {"SAMPLES", "1"}, {"SMOOTH", "1"}});
    ASSERT_TRUE(source);
    EXPECT_NE(complaints(folder_, kStages[0], source->text), "") << "another stage";
}

class ShaderPrograms : public gpu::GlTest {};

// Whatever the reference compiler accepts, stages must fit each other too.
TEST_F(ShaderPrograms, EveryPairLinksOnTheDriver) {
    const std::map<std::string, std::string> pairs = {
        {"terrane/render/gbuffer.frag.glsl", "terrane/render/quad.vert.glsl"},
        {"terrane/render/shadow.frag.glsl", "terrane/render/quad.vert.glsl"},
        {"terrane/render/layer.frag.glsl", "terrane/render/quad.vert.glsl"}};
    for (const base::EmbeddedFile& file : embedded::shaders()) {
        const Stage* stage = stageOf(file.path);
        if (!stage || stage->stage == gpu::ShaderStage::Vertex) continue;
        const auto pair = pairs.find(std::string(file.path));
        const std::string vertex = pair != pairs.end() ? pair->second : "terrane/render/fullscreen.vert.glsl";
        for (const gpu::ShaderDefines& defines : variantsOf(file.path)) {
            const auto program =
                stage->stage == gpu::ShaderStage::Compute
                    ? gpu::Program::compute(contentShaders(), file.path, defines, "test")
                    : gpu::Program::graphics(contentShaders(), vertex, file.path, defines, "test");
            EXPECT_TRUE(program) << file.path << ": " << (program ? "" : program.error().message);
        }
    }
}

}  // namespace
}  // namespace terrane::render
