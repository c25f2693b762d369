#include "terrane/path/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <string>

#include "terrane/base/files.h"

namespace terrane::path {
namespace {

// Collects the file, so that it is written in one piece as all others are.
class MemoryStream : public Imf::OStream {
  public:
    MemoryStream() : Imf::OStream("memory") {}

    void write(const char* bytes, int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (text.size() < at_ + size) text.resize(at_ + size);
        std::copy_n(bytes, size, text.begin() + static_cast<std::ptrdiff_t>(at_));
        at_ += size;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t place) override { at_ = place; }

    std::string text;

  private:
    std::size_t at_ = 0;
};

struct Channel {
    const char* name;
    float* first;
    std::size_t stride;  // floats
};

std::vector<Channel> channelsOf(Means& means) {
    const auto part = [](std::vector<glm::vec3>& colors, int c) { return &colors.front()[c]; };
    return {{"R", part(means.radiance, 0), 3},      {"G", part(means.radiance, 1), 3},
            {"B", part(means.radiance, 2), 3},      {"albedo.R", part(means.albedo, 0), 3},
            {"albedo.G", part(means.albedo, 1), 3}, {"albedo.B", part(means.albedo, 2), 3},
            {"normal.X", part(means.normal, 0), 3}, {"normal.Y", part(means.normal, 1), 3},
            {"normal.Z", part(means.normal, 2), 3}, {"Z", means.depth.data(), 1},
            {"variance", means.variance.data(), 1}};
}

// `means`: a copy, because slices are of memory that may be written.
void encode(MemoryStream& stream, Means means, const ExrNotes& notes) {
    Imf::Header header(means.size.x, means.size.y);
    header.insert("samples", Imf::IntAttribute(static_cast<int>(notes.samples)));
    if (notes.isDenoised) header.insert("comments", Imf::StringAttribute("denoised: biased"));
    Imf::FrameBuffer buffer;
    for (const Channel& channel : channelsOf(means)) {
        header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
        const std::size_t x = channel.stride * sizeof(float);
        auto* base = reinterpret_cast<char*>(channel.first);
        buffer.insert(channel.name,
                      Imf::Slice(Imf::FLOAT, base, x, x * static_cast<std::size_t>(means.size.x)));
    }
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(buffer);
    file.writePixels(means.size.y);
}

}  // namespace

base::Result<void> writeExr(const std::filesystem::path& path, const Means& means, const ExrNotes& notes) {
    MemoryStream stream;
    try {
        encode(stream, means, notes);
    } catch (const std::exception& error) {
        return base::fail("{}: {}", path.string(), base::textOf(error));
    }
    return base::writeFile(path, stream.text);
}

bool hasExr() {
    return true;
}

}  // namespace terrane::path
