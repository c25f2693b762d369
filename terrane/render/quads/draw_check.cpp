#include "terrane/render/quads/draw_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrane/base/log.h"
#include "terrane/gpu/framebuffer.h"
#include "terrane/gpu/pipeline_state.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/texture.h"
#include "terrane/gpu/vertex_array.h"
#include "terrane/render/quads/draw_commands.h"
#include "terrane/shared/bindings.h"
#include "terrane/shared/draw_check.h"
#include "terrane/shared/mesh_section.h"

namespace terrane::render {
namespace {

constexpr int kCheckPixelsOfSide = static_cast<int>(shared::kCheckSide);
constexpr std::uint32_t kPixels = shared::kCheckSide * shared::kCheckSide;
constexpr std::uint32_t kQuadsOfCommand = 2;
// The last pixels are of the commands after the counted ones.
constexpr std::uint32_t kPatternCommands = kPixels / kQuadsOfCommand - 1, kBeyond = 32;
constexpr int kFinestBits = 8;

using CheckPixels = std::vector<std::uint32_t>;

struct CheckList {
    std::vector<shared::DrawCommand> commands;
    std::vector<shared::DrawRecord> records;

    void add(shared::DrawRecord record, std::uint32_t quads) {
        const auto number = static_cast<std::uint32_t>(commands.size());
        commands.push_back({6 * quads, 1, 0, 0, number});
        records.push_back(record);
    }
};

// Values of all 32 bits: an integer that goes through a float loses some.
glm::ivec2 numbersOf(std::uint32_t command) {
    return {static_cast<std::int32_t>(0x7fff'ffffu - command),
            static_cast<std::int32_t>(0x8000'0001u + 3 * command)};
}

CheckList patternList() {
    CheckList list;
    for (std::uint32_t k = 0; k < kPatternCommands; ++k)
        list.add({numbersOf(k), shared::kWholePixel, shared::kFirstListedQuad + kQuadsOfCommand * k},
                 kQuadsOfCommand);
    return list;
}

CheckPixels expectedPattern() {
    CheckPixels pixels;
    for (std::uint32_t k = 0; k < kPatternCommands * kQuadsOfCommand; ++k)
        pixels.push_back(shared::checkValue(numbersOf(k / kQuadsOfCommand), k % kQuadsOfCommand));
    pixels.resize(kPixels);
    return pixels;
}

// Pixel k is covered if the grid has fewer than k + 1 bits.
CheckList gridList() {
    CheckList list;
    for (std::uint32_t bits = 1; bits <= kFinestBits; ++bits)
        list.add({numbersOf(bits), bits, shared::kFirstListedQuad + bits - 1}, 1);
    return list;
}

int bitsOfGrid(const CheckPixels& pixels) {
    int bits = 0;
    while (bits < kFinestBits && pixels[static_cast<std::size_t>(bits)] == 0) ++bits;
    return bits;
}

// Sets the viewport of the window again at the end.
class WindowViewport {
  public:
    WindowViewport() { glGetIntegerv(GL_VIEWPORT, corners_.data()); }
    ~WindowViewport() { glViewport(corners_[0], corners_[1], corners_[2], corners_[3]); }
    WindowViewport(const WindowViewport&) = delete;
    WindowViewport& operator=(const WindowViewport&) = delete;

  private:
    std::array<GLint, 4> corners_{};
};

// Draws lists of commands into an image of integers.
class Checker {
  public:
    static base::Result<Checker> create(const gpu::ShaderLoader& shaders) {
        Checker checker;
        checker.program_ = TERRANE_TRY(
            gpu::Program::graphics(shaders, "terrane/render/quads/draw_check.vert.glsl",
                                   "terrane/render/quads/draw_check.frag.glsl", {}, "check draws"));
        checker.image_ = gpu::Texture2D({kCheckPixelsOfSide, kCheckPixelsOfSide}, GL_R32UI, 1, "check draws");
        checker.target_ = TERRANE_TRY(gpu::Framebuffer::create({{checker.image_}, {}}, "check draws"));
        const std::array<std::uint16_t, 12> indices = {0, 1, 2, 2, 1, 3, 4, 5, 6, 6, 5, 7};
        checker.indices_ = gpu::Buffer(std::as_bytes(std::span(indices)), 0, "check draws");
        checker.vertexArray_ = gpu::VertexArray("check draws");
        checker.vertexArray_.setElementBuffer(checker.indices_);
        return checker;
    }

    // `isCounted`: the GPU reads the count; otherwise the commands after the list draw nothing.
    CheckPixels draw(DrawMethod method, bool isCounted, const CheckList& list) {
        const GLuint zero = 0;
        glClearTexImage(image_.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
        const auto count = static_cast<std::uint32_t>(list.commands.size());
        std::vector<shared::DrawCommand> commands = list.commands;
        std::vector<shared::DrawRecord> records = list.records;
        const std::uint32_t quads = isCounted ? 1 : 0;
        commands.insert(commands.end(), kBeyond, {6 * quads, quads, 0, 0, count});
        records.push_back({numbersOf(count), shared::kWholePixel, shared::kFirstListedQuad + kPixels - 1});
        const gpu::Buffer commandBuffer(std::as_bytes(std::span(commands)), 0, "check draws"),
            recordBuffer(std::as_bytes(std::span(records)), 0, "check draws"),
            countBuffer(std::as_bytes(std::span(&count, 1)), 0, "check draws");
        vertexArray_.setInstanceIntegers(shared::kDrawRecordAttribute, recordBuffer,
                                         sizeof(shared::DrawRecord) / sizeof(GLint),
                                         sizeof(shared::DrawRecord));
        vertexArray_.bind();
        target_.bind();
        program_.use();
        gpu::Pipeline().set({});
        drawCommands(method, {.commands = &commandBuffer,
                              .count = count + kBeyond,
                              .counts = isCounted ? &countBuffer : nullptr,
                              .onCpu = list.commands});
        CheckPixels pixels(kPixels);
        glGetTextureImage(image_.id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                          static_cast<GLsizei>(pixels.size() * sizeof(pixels[0])), pixels.data());
        gpu::Program::useNone();
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        return pixels;
    }

  private:
    gpu::Program program_;
    gpu::Texture2D image_;
    gpu::Framebuffer target_;
    gpu::Buffer indices_;
    gpu::VertexArray vertexArray_;
};

std::size_t wrongPixels(const CheckPixels& pixels) {
    const CheckPixels expected = expectedPattern();
    std::size_t count = 0;
    for (std::size_t k = 0; k < pixels.size(); ++k) count += pixels[k] != expected[k];
    return count;
}

}  // namespace

base::Result<DrawCheck> checkDraws(const gpu::ShaderLoader& shaders, const gpu::DeviceInfo& device) {
    auto checker = TERRANE_TRY(Checker::create(shaders));
    const WindowViewport kept;
    const CheckList pattern = patternList();
    const auto wrongWith = [&](DrawMethod method, bool isCounted) {
        return wrongPixels(checker.draw(method, isCounted, pattern));
    };
    DrawCheck check;
    const std::size_t counted = device.indirectCount ? wrongWith(DrawMethod::Indirect, true) : 0;
    check.indirectCount = device.indirectCount && counted == 0;
    const std::size_t whole = check.indirectCount ? 0 : wrongWith(DrawMethod::Indirect, false);
    check.indirect = whole == 0;
    if (whole > 0) {
        check.fault = fmt::format(
            "lists of draws are drawn wrongly ({} of {} pixels of a test), so that each "
            "draw is a call of its own, as with --draw loop",
            whole, kPixels);
        if (const std::size_t single = wrongWith(DrawMethod::Loop, false); single > 0)
            check.fault += fmt::format("; that is wrong too ({} pixels)", single);
    } else if (counted > 0) {
        check.fault = fmt::format(
            "lists of draws with a count of the GPU are drawn wrongly ({} of {} pixels of a "
            "test), so that lists are drawn in full",
            counted, kPixels);
    }
    const DrawMethod method = check.indirect ? DrawMethod::Indirect : DrawMethod::Loop;
    check.subpixelBits = bitsOfGrid(checker.draw(method, check.indirectCount, gridList()));
    if (check.subpixelBits < std::min(device.subpixelBits, kFinestBits)) {
        check.fault += fmt::format("{}edges lie on a grid of {} bits instead of {}",
                                   check.fault.empty() ? "" : "; ", check.subpixelBits, device.subpixelBits);
    }
    return check;
}

gpu::DeviceInfo checkedDevice(const gpu::ShaderLoader& shaders) {
    gpu::DeviceInfo device = gpu::queryDevice();
    const base::Result<DrawCheck> check = checkDraws(shaders, device);
    if (!check) {
        base::logWarning("the graphics driver is not checked: {}", check.error().message);
        return device;
    }
    if (!check->fault.empty()) base::logWarning("{}: {}", device.renderer, check->fault);
    device.indirectCount = check->indirectCount;
    device.indirectDraws = check->indirect;
    device.subpixelBits = std::min(device.subpixelBits, check->subpixelBits);
    return device;
}

}  // namespace terrane::render
