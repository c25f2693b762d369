#include "terrane/formats/vox_file.h"

#include <glm/common.hpp>

#include "terrane/formats/block_volume.h"
#include "terrane/formats/vox_scene_internal.h"

namespace terrane::formats {
namespace {

// Models may be shown many times: 2^27 voxels take about a second.
constexpr std::size_t kMaxPlacedVoxels = std::size_t{1} << 27;

struct VoxBox {
    glm::ivec3 low{0}, high{0};  // both inclusive
};

VoxBox boxOf(const VoxParts& parts, const std::vector<PlacedModel>& models) {
    VoxBox box{glm::ivec3(INT32_MAX), glm::ivec3(INT32_MIN)};
    for (const PlacedModel& placement : models) {
        const glm::ivec3 size = parts.models[placement.model].size;
        for (const glm::ivec3 corner : {glm::ivec3(0), size - 1}) {
            const glm::ivec3 at = placed(placement.transform, size, corner);
            box.low = glm::min(box.low, at);
            box.high = glm::max(box.high, at);
        }
    }
    return box;
}

std::size_t cellOf(glm::ivec3 at, glm::ivec3 size) {
    return static_cast<std::size_t>(at.x + std::int64_t{size.x} * (at.y + std::int64_t{size.y} * at.z));
}

base::Result<void> putModel(const VoxModel& model, const VoxTransform& transform, glm::ivec3 low,
                            VoxImage& image) {
    for (std::size_t k = 0; k + 3 < model.voxels.size(); k += 4) {
        const auto byte = [&](std::size_t n) {
            return static_cast<int>(static_cast<std::uint8_t>(model.voxels[k + n]));
        };
        const glm::ivec3 voxel(byte(0), byte(1), byte(2));
        if (voxel.x >= model.size.x || voxel.y >= model.size.y || voxel.z >= model.size.z)
            return base::fail(base::ErrorCode::Damaged, ".vox: a voxel lies outside its model");
        if (byte(3) == 0) continue;
        image.cells[cellOf(placed(transform, model.size, voxel) - low, image.size)] =
            static_cast<std::uint8_t>(byte(3));
    }
    return {};
}

class VoxWriter {
  public:
    void number(std::int64_t value) {
        for (unsigned k = 0; k < 4; ++k) bytes.push_back(static_cast<char>(value >> (8 * k)));
    }
    void text(std::string_view text) {
        number(static_cast<std::int64_t>(text.size()));
        bytes += text;
    }
    void part(std::string_view kind, const VoxWriter& content) {
        bytes += kind;
        number(static_cast<std::int64_t>(content.bytes.size()));
        number(0);
        bytes += content.bytes;
    }

    std::string bytes;
};

// Writes the part of the image from `low` on, at most kMaxVoxSide in each direction.
void writeModel(const VoxImage& image, glm::ivec3 low, glm::ivec3 size, VoxWriter& out) {
    VoxWriter sides, voxels;
    for (int axis = 0; axis < 3; ++axis) sides.number(size[axis]);
    std::int64_t count = 0;
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const std::uint8_t color = image.cells[cellOf(low + glm::ivec3(x, y, z), image.size)];
                if (color == 0) continue;
                for (const int value : {x, y, z, static_cast<int>(color)})
                    voxels.bytes.push_back(static_cast<char>(value));
                ++count;
            }
        }
    }
    VoxWriter content;
    content.number(count);
    content.bytes += voxels.bytes;
    out.part("SIZE", sides);
    out.part("XYZI", content);
}

struct ModelPlace {
    glm::ivec3 low, size;
};

std::vector<ModelPlace> modelPlaces(glm::ivec3 size) {
    std::vector<ModelPlace> places;
    for (int z = 0; z < size.z; z += kMaxVoxSide)
        for (int y = 0; y < size.y; y += kMaxVoxSide)
            for (int x = 0; x < size.x; x += kMaxVoxSide) {
                const glm::ivec3 low(x, y, z);
                places.push_back({low, glm::min(size - low, glm::ivec3(kMaxVoxSide))});
            }
    return places;
}

// Writes the node `id` with the child `child`, moved by `step` unless empty.
void writeTransform(int id, int child, const std::string& step, VoxWriter& out) {
    VoxWriter node;
    for (const int value : {id, 0, child, -1, id == 0 ? -1 : 0, 1}) node.number(value);
    node.number(step.empty() ? 0 : 1);
    if (!step.empty()) {
        node.text("_t");
        node.text(step);
    }
    out.part("nTRN", node);
}

// Writes a group of models, each moved to its place: nodes 0 (the root), 1 (the group), then two for each
// model.
void writeScene(const std::vector<ModelPlace>& places, VoxWriter& out) {
    writeTransform(0, 1, "", out);
    VoxWriter group;
    const auto count = static_cast<int>(places.size());
    for (const int value : {1, 0, count}) group.number(value);
    for (int k = 0; k < count; ++k) group.number(2 + 2 * k);
    out.part("nGRP", group);
    for (int k = 0; k < count; ++k) {
        const ModelPlace& place = places[static_cast<std::size_t>(k)];
        const glm::ivec3 middle = place.low + place.size / 2;
        writeTransform(2 + 2 * k, 3 + 2 * k, fmt::format("{} {} {}", middle.x, middle.y, middle.z), out);
        VoxWriter shape;
        for (const int value : {3 + 2 * k, 0, 1, k, 0}) shape.number(value);
        out.part("nSHP", shape);
    }
}

}  // namespace

// 6 levels a channel without black, then ten shades each of red, green, blue and gray (MagicaVoxel's
// description of the format, github.com/ephtracy/voxel-model).
std::array<std::uint32_t, 256> defaultVoxColors() {
    std::array<std::uint32_t, 256> colors{};
    std::size_t next = 1;
    const auto add = [&](std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
        colors[next++] = red << 24 | green << 16 | blue << 8 | 0xff;
    };
    for (std::uint32_t k = 0; k < 215; ++k)
        add(255 - 51 * (k / 36), 255 - 51 * (k / 6 % 6), 255 - 51 * (k % 6));
    constexpr std::array<std::uint32_t, 10> kShades{0xee, 0xdd, 0xbb, 0xaa, 0x88,
                                                    0x77, 0x55, 0x44, 0x22, 0x11};
    for (const std::uint32_t shade : kShades) add(shade, 0, 0);
    for (const std::uint32_t shade : kShades) add(0, shade, 0);
    for (const std::uint32_t shade : kShades) add(0, 0, shade);
    for (const std::uint32_t shade : kShades) add(shade, shade, shade);
    return colors;
}

base::Result<VoxImage> decodeVox(std::string_view bytes) {
    const auto parts = TERRANE_TRY(readVoxParts(bytes));
    const auto models = TERRANE_TRY(placedModels(parts));
    const VoxBox box = boxOf(parts, models);
    VoxImage image;
    const std::array<std::int64_t, 3> sides{std::int64_t{box.high.x} - box.low.x + 1,
                                            std::int64_t{box.high.y} - box.low.y + 1,
                                            std::int64_t{box.high.z} - box.low.z + 1};
    TERRANE_TRY(checkVolumeSize(sides[0], sides[1], sides[2]));
    image.size = box.high - box.low + 1;
    image.colors = parts.colors;
    image.cells.resize(static_cast<std::size_t>(sides[0] * sides[1] * sides[2]));
    std::size_t voxels = 0;
    for (const PlacedModel& placement : models) {
        const VoxModel& model = parts.models[placement.model];
        voxels += model.voxels.size() / 4;
        if (voxels > kMaxPlacedVoxels)
            return base::fail(base::ErrorCode::OutOfResources, ".vox: more than {} voxels", kMaxPlacedVoxels);
        TERRANE_TRY(putModel(model, placement.transform, box.low, image));
    }
    return image;
}

std::string encodeVox(const VoxImage& image) {
    VoxWriter parts, colors;
    const std::vector<ModelPlace> places = modelPlaces(image.size);
    for (const ModelPlace& place : places) writeModel(image, place.low, place.size, parts);
    if (places.size() > 1) writeScene(places, parts);
    for (std::size_t k = 1; k <= image.colors.size(); ++k) {
        const std::uint32_t color = k < image.colors.size() ? image.colors[k] : 0;
        for (unsigned byte = 4; byte-- > 0;) colors.bytes.push_back(static_cast<char>(color >> (8 * byte)));
    }
    parts.part("RGBA", colors);
    VoxWriter file;
    file.bytes = "VOX ";
    file.number(150);
    file.bytes += "MAIN";
    file.number(0);
    file.number(static_cast<std::int64_t>(parts.bytes.size()));
    file.bytes += parts.bytes;
    return std::move(file.bytes);
}

}  // namespace terrane::formats
