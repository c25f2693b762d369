// Drivers that draw wrongly are found, and images are right on them: functions of OpenGL are replaced by
// others that make known errors.
#include "terrane/render/quads/draw_check.h"

#include <epoxy/egl.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "terrane/gpu/buffer.h"
#include "terrane/render/frame/renderer.h"
#include "terrane/shared/mesh_section.h"
#include "tests/golden/scenes.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/render/content.h"

namespace terrane::render {
namespace {

using Commands = std::vector<shared::DrawCommand>;
// Changes the commands of a draw.
using DriverError = std::function<void(Commands&)>;

// While it lives, lists of draws have the error.
class FaultyDriver {
  public:
    // `ignoresCounts`: the most commands are drawn instead.
    explicit FaultyDriver(DriverError error, bool ignoresCounts = false) {
        error_ = std::move(error);
        ignoresCounts_ = ignoresCounts;
        // The variables point to functions that set them at the first call.
        real_ = reinterpret_cast<decltype(real_)>(eglGetProcAddress("glMultiDrawElementsIndirect"));
        list_ = epoxy_glMultiDrawElementsIndirect;
        countedList_ = epoxy_glMultiDrawElementsIndirectCountARB;
        epoxy_glMultiDrawElementsIndirect = &drawList;
        epoxy_glMultiDrawElementsIndirectCountARB = &drawCountedList;
    }
    ~FaultyDriver() {
        epoxy_glMultiDrawElementsIndirect = list_;
        epoxy_glMultiDrawElementsIndirectCountARB = countedList_;
    }
    FaultyDriver(const FaultyDriver&) = delete;
    FaultyDriver& operator=(const FaultyDriver&) = delete;

  private:
    static GLuint bound(GLenum binding) {
        GLint id = 0;
        glGetIntegerv(binding, &id);
        return static_cast<GLuint>(id);
    }
    static void drawWrongly(GLenum mode, GLenum type, const void* offset, GLsizei count) {
        const GLuint buffer = bound(GL_DRAW_INDIRECT_BUFFER_BINDING);
        Commands commands(static_cast<std::size_t>(count));
        if (count > 0)
            glGetNamedBufferSubData(buffer, reinterpret_cast<GLintptr>(offset),
                                    static_cast<GLsizeiptr>(commands.size() * sizeof(commands[0])),
                                    commands.data());
        error_(commands);
        if (commands.empty()) return;
        const gpu::Buffer wrong(std::as_bytes(std::span(commands)), 0, "wrong commands");
        glBindBuffer(GL_DRAW_INDIRECT_BUFFER, wrong.id());
        glBindBuffer(GL_PARAMETER_BUFFER_ARB, 0);  // see draw_commands.cpp
        real_(mode, type, nullptr, static_cast<GLsizei>(commands.size()), 0);
        glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer);
    }
    static void EPOXY_CALLSPEC drawList(GLenum mode, GLenum type, const void* offset, GLsizei count,
                                        GLsizei) {
        drawWrongly(mode, type, offset, count);
    }
    static void EPOXY_CALLSPEC drawCountedList(GLenum mode, GLenum type, const void* offset,
                                               GLintptr countOffset, GLsizei most, GLsizei) {
        GLuint count = 0;
        glGetNamedBufferSubData(bound(GL_PARAMETER_BUFFER_BINDING_ARB), countOffset, sizeof(count), &count);
        drawWrongly(mode, type, offset, ignoresCounts_ ? most : std::min(most, static_cast<GLsizei>(count)));
    }

    inline static DriverError error_;
    inline static bool ignoresCounts_ = false;
    inline static decltype(epoxy_glMultiDrawElementsIndirect) list_ = nullptr, real_ = nullptr;
    inline static decltype(epoxy_glMultiDrawElementsIndirectCountARB) countedList_ = nullptr;
};

void nothingWrong(Commands&) {}
void loseHalf(Commands& commands) {
    commands.resize(commands.size() / 2);
}
void ignoreBaseInstances(Commands& commands) {
    for (shared::DrawCommand& command : commands) command.baseInstance = 0;
}
void drawNothing(Commands& commands) {
    commands.clear();
}

class DrawCheckTest : public gpu::GlTest {
  protected:
    static DrawCheck check(const gpu::DeviceInfo& device = gpu::queryDevice()) {
        auto checked = checkDraws(contentShaders(), device);
        if (!checked) throw std::runtime_error(checked.error().message);
        return *std::move(checked);
    }

    static base::Image imageOn(const gpu::DeviceInfo& device) {
        auto renderer = Renderer::create(contentShaders(), contentBlocks(), contentTexture, device);
        if (!renderer) throw std::runtime_error(renderer.error().message);
        world::World world = golden::flatWorld(3);
        golden::placeGallery(world);
        golden::placePool(world);
        for (const auto& [pos, mesh] : golden::meshWorld(world)) renderer->setChunk(pos, mesh);
        RenderOptions options;
        options.msaaSamples = 2;
        options.draw = DrawMethod::Indirect;
        EXPECT_TRUE(renderer->configure({160, 90}, options));
        const FrameInput input{{{-9, 5, 86}, 10, -14}, world::environmentAt(0.4f), 120, 1, View::Color};
        for (int frame = 0; frame < 3; ++frame) renderer->draw(input);
        return renderer->readImage();
    }
};

TEST_F(DrawCheckTest, ThisDriverDrawsRight) {
    const gpu::DeviceInfo device = gpu::queryDevice();
    const DrawCheck checked = check(device);
    EXPECT_EQ(checked.fault, "");
    EXPECT_TRUE(checked.indirect);
    EXPECT_EQ(checked.indirectCount, device.indirectCount);
    EXPECT_GE(checked.subpixelBits, std::min(device.subpixelBits, 8));
    gpu::DeviceInfo without = device;
    without.indirectCount = false;
    EXPECT_FALSE(check(without).indirectCount);
    EXPECT_TRUE(check(without).indirect);
    EXPECT_TRUE(checkedDevice(contentShaders()).indirectDraws);
}

TEST_F(DrawCheckTest, AGridCoarserThanReportedIsFound) {
    gpu::DeviceInfo device = gpu::queryDevice();
    device.subpixelBits = 8;
    const int bits = check(device).subpixelBits;
    EXPECT_GE(bits, 4) << "OpenGL 4.5";
    EXPECT_LE(bits, 8) << "finer grids are drawn for as this one";
}

TEST_F(DrawCheckTest, ErrorsOfDriversAreFound) {
    for (const auto& [name, error] : {std::pair<const char*, DriverError>("lost draws", loseHalf),
                                      {"ignored base instances", ignoreBaseInstances},
                                      {"nothing drawn", drawNothing}}) {
        const FaultyDriver driver(error);
        const DrawCheck checked = check();
        EXPECT_FALSE(checked.indirect) << name;
        EXPECT_FALSE(checked.indirectCount) << name;
        EXPECT_NE(checked.fault.find("--draw loop"), std::string::npos) << name << ": " << checked.fault;
        EXPECT_EQ(checked.fault.find("wrong too"), std::string::npos) << name << ": " << checked.fault;
        EXPECT_FALSE(checkedDevice(contentShaders()).indirectDraws) << name;
    }
}

TEST_F(DrawCheckTest, OnlyCountsMayBeWrong) {
    if (!gpu::queryDevice().indirectCount) GTEST_SKIP() << "1 test skipped: the driver has no counts";
    const FaultyDriver driver(nothingWrong, true);
    const DrawCheck checked = check();
    EXPECT_TRUE(checked.indirect);
    EXPECT_FALSE(checked.indirectCount);
    EXPECT_NE(checked.fault.find("count"), std::string::npos) << checked.fault;
    EXPECT_FALSE(checkedDevice(contentShaders()).indirectCount);
}

TEST_F(DrawCheckTest, ImagesAreRightOnFaultyDrivers) {
    const base::Image expected = imageOn(gpu::queryDevice());
    const auto isRight = [&](DriverError error, bool ignoresCounts) {
        const FaultyDriver driver(std::move(error), ignoresCounts);
        return imageOn(checkedDevice(contentShaders())).rgba == expected.rgba;
    };
    EXPECT_TRUE(isRight(loseHalf, false));
    EXPECT_TRUE(isRight(ignoreBaseInstances, false));
    EXPECT_TRUE(isRight(drawNothing, false));
    EXPECT_TRUE(isRight(nothingWrong, true));
    const FaultyDriver driver(drawNothing);
    EXPECT_NE(imageOn(gpu::queryDevice()).rgba, expected.rgba) << "without the check it is wrong";
}

}  // namespace
}  // namespace terrane::render
