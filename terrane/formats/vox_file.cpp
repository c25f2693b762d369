#include "terrane/formats/vox_file.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "terrane/formats/block_volume.h"
#include "terrane/formats/vox_file_internal.h"

namespace terrane::formats {

namespace {

// sRGB to linear, IEC 61966-2-1.
float linear(float srgb) {
    return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

// B. Ottosson, "A perceptual color space for image processing" (2020). `srgb` is 0…255.
glm::vec3 oklabOf(glm::vec3 srgb) {
    const float r = linear(srgb.x / 255), g = linear(srgb.y / 255), b = linear(srgb.z / 255);
    const float l = std::cbrt(0.4122214708f * r + 0.5363325363f * g + 0.0514459929f * b);
    const float m = std::cbrt(0.2119034982f * r + 0.6806995451f * g + 0.1073969566f * b);
    const float s = std::cbrt(0.0883024619f * r + 0.2817188376f * g + 0.6299787005f * b);
    return {0.2104542553f * l + 0.7936177850f * m - 0.0040720468f * s,
            1.9779984951f * l - 2.4285922050f * m + 0.4505937099f * s,
            0.0259040371f * l + 0.7827717662f * m - 0.8086757660f * s};
}

glm::vec3 channelsOf(std::uint32_t color) {
    return {color >> 16 & 255, color >> 8 & 255, color & 255};
}

std::uint32_t colorOf(glm::vec3 mean) {
    const auto channel = [](float value) { return static_cast<std::uint32_t>(std::lround(value)); };
    return channel(mean.x) << 16 | channel(mean.y) << 8 | channel(mean.z);
}

}  // namespace

world::BlockId nearestCube(std::uint32_t color, const world::BlockRegistry& blocks,
                           const world::TopColors& tops) {
    const glm::vec3 wanted = oklabOf(channelsOf(color));
    world::BlockId nearest = blocks.missing();
    float least = INFINITY;
    for (const world::BlockType& type : blocks.types()) {
        if (!type.opaqueCube || type.id == blocks.missing() || tops[type.id].tinted) continue;
        const glm::vec3 away = oklabOf(tops[type.id].mean) - wanted;
        const float distance = glm::dot(away, away);
        if (distance >= least) continue;
        least = distance;
        nearest = type.id;
    }
    return nearest;
}

BlockVolume toBlocks(const VoxImage& image, const BlockMapping& mapping, const world::BlockRegistry& blocks,
                     const world::TopColors& tops) {
    BlockVolume volume{image.size, {}, {image.cells.begin(), image.cells.end()}};
    std::vector<bool> isUsed(image.colors.size());
    for (const std::uint8_t cell : image.cells) isUsed[cell] = true;
    volume.palette.resize(image.colors.size());
    for (std::size_t k = 1; k < image.colors.size(); ++k) {
        if (!isUsed[k]) continue;
        const std::uint32_t color = image.colors[k] >> 8;
        const auto named = mapping.colors().find(color);
        const bool isNamed = named != mapping.colors().end();
        volume.palette[k].id = isNamed ? named->second : nearestCube(color, blocks, tops);
    }
    return volume;
}

base::Result<VoxImage> toVox(const BlockVolume& volume, const world::TopColors& tops) {
    VoxImage image;
    image.size = volume.size;
    std::unordered_map<std::uint32_t, std::uint8_t> numbers;
    std::vector<std::int16_t> numberOf(volume.palette.size(), -1);
    image.cells.reserve(volume.cells.size());
    for (const std::uint16_t cell : volume.cells) {
        std::int16_t& number = numberOf[cell];
        const world::BlockId id = volume.palette[cell].id;
        if (number < 0 && id == world::kAir) number = 0;
        if (number < 0) {
            const std::uint32_t color = colorOf(tops[id < tops.size() ? id : 0].mean);
            const auto [place, isNew] = numbers.emplace(color, static_cast<std::uint8_t>(numbers.size() + 1));
            if (numbers.size() > 255) return base::fail("the blocks have more than 255 colors");
            number = place->second;
            if (isNew) image.colors[place->second] = color << 8 | 0xff;
        }
        image.cells.push_back(static_cast<std::uint8_t>(number));
    }
    return image;
}

// Places the models of a .vox file.

namespace {

constexpr int kMaxVoxDepth = 64;
// Groups may be used several times, and so may groups in them: visits are limited, not nodes.
constexpr std::size_t kMaxVoxVisits = 1'000'000;

class SceneWalk {
  public:
    explicit SceneWalk(const VoxParts& parts) : parts_(parts) {}

    base::Result<std::vector<PlacedModel>> run() {
        visit(0, {}, 0);
        if (!problem_.empty()) return base::fail(base::ErrorCode::Damaged, ".vox: {}", problem_);
        if (models_.empty()) return base::fail(base::ErrorCode::Damaged, ".vox: its scene shows no model");
        return std::move(models_);
    }

  private:
    void visit(std::int32_t id, const VoxTransform& transform, int depth) {
        if (depth > kMaxVoxDepth) problem_ = "its scene is too deep";
        if (++visits_ > kMaxVoxVisits) problem_ = "its scene is too large";
        const auto found = parts_.nodes.find(id);
        if (found == parts_.nodes.end()) problem_ = "a node of its scene is missing";
        if (!problem_.empty() || found->second.isHidden) return;
        const VoxNode& node = found->second;
        if (node.kind == VoxNode::Kind::Shape) return place(node, transform);
        const VoxTransform inner =
            node.kind == VoxNode::Kind::Transform ? combined(transform, node.transform) : transform;
        for (const std::int32_t child : node.children) {
            visit(child, inner, depth + 1);
            if (!problem_.empty()) return;
        }
    }

    // Takes the first model of an animation.
    void place(const VoxNode& shape, const VoxTransform& transform) {
        if (shape.children.empty()) return;
        const auto model = static_cast<std::size_t>(shape.children[0]);
        if (shape.children[0] < 0 || model >= parts_.models.size())
            problem_ = "a model of its scene is missing";
        else
            models_.push_back({model, transform});
    }

    const VoxParts& parts_;
    std::vector<PlacedModel> models_;
    std::string problem_;
    std::size_t visits_ = 0;
};

std::size_t at(int axis) {
    return static_cast<std::size_t>(axis);
}

}  // namespace

VoxTransform combined(const VoxTransform& outer, const VoxTransform& inner) {
    VoxTransform result;
    result.step = outer.step;
    for (int row = 0; row < 3; ++row) {
        const int axis = outer.axis[at(row)], sign = outer.sign[at(row)];
        result.axis[at(row)] = inner.axis[at(axis)];
        result.sign[at(row)] = sign * inner.sign[at(axis)];
        result.step[row] += sign * inner.step[axis];
    }
    return result;
}

// Computes with twice the middle of the voxel, which is odd: half of one less is the voxel again.
glm::ivec3 placed(const VoxTransform& transform, glm::ivec3 modelSize, glm::ivec3 voxel) {
    const glm::ivec3 twice = 2 * (voxel - modelSize / 2) + 1;
    glm::ivec3 result(0);
    for (int row = 0; row < 3; ++row) {
        const int turned = transform.sign[at(row)] * twice[transform.axis[at(row)]];
        result[row] = (turned - 1) / 2 + ((turned - 1) % 2 < 0 ? -1 : 0) + transform.step[row];
    }
    return result;
}

base::Result<std::vector<PlacedModel>> placedModels(const VoxParts& parts) {
    if (!parts.nodes.empty()) return SceneWalk(parts).run();
    VoxTransform atOrigin;
    atOrigin.step = parts.models[0].size / 2;
    return std::vector<PlacedModel>{{0, atOrigin}};
}

// Reads the chunks of a .vox file.

namespace {

// Files with thousands of models exist.
constexpr std::size_t kMaxVoxModels = 65536, kMaxVoxNodes = 262144;

using VoxDictionary = std::map<std::string_view, std::string_view>;

// Reads until data is missing or invalid; then it is bad and gives zeros.
class VoxReader {
  public:
    explicit VoxReader(std::string_view bytes) : bytes_(bytes) {}

    bool isBad() const { return isBad_; }
    bool isAtEnd() const { return isBad_ || bytes_.empty(); }

    std::string_view take(std::size_t count) {
        if (isBad_ || count > bytes_.size()) {
            isBad_ = true;
            return {};
        }
        const std::string_view taken = bytes_.substr(0, count);
        bytes_.remove_prefix(count);
        return taken;
    }

    std::int32_t number() {
        const std::string_view four = take(4);
        std::uint32_t value = 0;
        for (std::size_t k = four.size(); k-- > 0;) value = value << 8 | static_cast<std::uint8_t>(four[k]);
        return static_cast<std::int32_t>(value);
    }

    // A number of bytes or elements; bad below 0.
    std::size_t count() {
        const std::int32_t value = number();
        if (value < 0) isBad_ = true;
        return isBad_ ? 0 : static_cast<std::size_t>(value);
    }

    std::string_view text() { return take(count()); }

    VoxDictionary dictionary() {
        constexpr std::size_t kMaxEntries = 256;  // files have ten at most
        VoxDictionary entries;
        std::size_t left = count();
        if (left > kMaxEntries) isBad_ = true;
        for (; left > 0 && !isBad_; --left) {
            const std::string_view key = text();
            entries[key] = text();
        }
        return entries;
    }

  private:
    std::string_view bytes_;
    bool isBad_ = false;
};

std::string_view valueOf(const VoxDictionary& entries, std::string_view key) {
    const auto found = entries.find(key);
    return found == entries.end() ? std::string_view() : found->second;
}

// Reads "x y z", 0 for missing numbers; none for other text, and for steps of more than 2^20 blocks: sums of
// nested ones must fit an int.
std::optional<glm::ivec3> stepOf(std::string_view text) {
    constexpr int kFarthest = 1 << 20;
    glm::ivec3 step(0);
    const char *at = text.data(), *end = text.data() + text.size();
    for (int axis = 0; axis < 3; ++axis) {
        while (at != end && *at == ' ') ++at;
        if (at == end) break;
        const auto [after, bad] = std::from_chars(at, end, step[axis]);
        if (bad != std::errc() || std::abs(std::int64_t{step[axis]}) > kFarthest) return std::nullopt;
        at = after;
    }
    return step;
}

// Bits 0–1 and 2–3: the columns of the entries of rows 0 and 1; bits 4–6: which rows are negative.
std::optional<VoxTransform> rotationOf(std::string_view text) {
    VoxTransform transform;
    if (text.empty()) return transform;
    unsigned bits = 0;
    const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), bits);
    const int first = static_cast<int>(bits & 3), second = static_cast<int>(bits >> 2 & 3);
    if (bad != std::errc() || end != text.data() + text.size() || first == 3 || second == 3 ||
        first == second)
        return std::nullopt;
    transform.axis = {first, second, 3 - first - second};
    for (unsigned row = 0; row < 3; ++row) transform.sign[row] = (bits >> (4 + row) & 1) != 0 ? -1 : 1;
    return transform;
}

void readChildren(VoxReader& reader, VoxNode& node, bool haveAttributes) {
    for (std::size_t left = reader.count(); left > 0 && !reader.isBad(); --left) {
        node.children.push_back(reader.number());
        if (haveAttributes) reader.dictionary();
    }
}

class VoxPartsReader {
  public:
    base::Result<VoxParts> read(std::string_view bytes) {
        VoxReader reader(bytes);
        if (reader.take(4) != "VOX ") return bad("its header is wrong");
        reader.number();  // version
        if (reader.take(4) != "MAIN") return bad("its part MAIN is missing");
        const std::size_t own = reader.count();
        reader.count();  // bytes of the parts inside; wrong in some files
        reader.take(own);
        parts_.colors = defaultVoxColors();
        while (!reader.isAtEnd()) {
            const std::string_view kind = reader.take(4);
            const std::size_t size = reader.count(), inside = reader.count();
            const std::string_view content = reader.take(size);
            reader.take(inside);
            if (!reader.isBad()) readPart(kind, content);
            if (!problem_.empty()) return bad(problem_);
        }
        if (reader.isBad()) return bad("it is cut off");
        if (parts_.models.empty()) return bad("it has no model");
        // Layers follow the nodes in the file.
        for (auto& [id, node] : parts_.nodes) node.isHidden |= hiddenLayers_.contains(node.layer);
        return std::move(parts_);
    }

  private:
    static tl::unexpected<base::Error> bad(std::string_view problem) {
        return base::fail(base::ErrorCode::Damaged, ".vox: {}", problem);
    }

    void readPart(std::string_view kind, std::string_view content) {
        VoxReader reader(content);
        if (kind == "SIZE")
            readSize(reader);
        else if (kind == "XYZI")
            readVoxels(reader);
        else if (kind == "RGBA")
            readColors(reader);
        else if (kind == "nTRN" || kind == "nGRP" || kind == "nSHP")
            readNode(kind, reader);
        else if (kind == "LAYR")
            readLayer(reader);
        if (reader.isBad() && problem_.empty()) problem_ = fmt::format("a part {} is cut off", kind);
    }

    void readSize(VoxReader& reader) {
        for (int axis = 0; axis < 3; ++axis) {
            size_[axis] = reader.number();
            if (size_[axis] < 1 || size_[axis] > kMaxVoxSide)
                problem_ = fmt::format("a model has {} blocks per side", size_[axis]);
        }
    }

    void readVoxels(VoxReader& reader) {
        const std::size_t count = reader.count();
        if (size_.x == 0) problem_ = "a model has no size";
        if (parts_.models.size() == kMaxVoxModels) problem_ = "it has too many models";
        parts_.models.push_back({size_, reader.take(count * 4)});
        size_ = glm::ivec3(0);
    }

    // The file has the colors 1 to 255, then an unused one.
    void readColors(VoxReader& reader) {
        for (std::size_t k = 1; k <= parts_.colors.size(); ++k) {
            std::uint32_t color = 0;
            for (const char c : reader.take(4)) color = color << 8 | static_cast<std::uint8_t>(c);
            if (k < parts_.colors.size()) parts_.colors[k] = color;
        }
    }

    void readLayer(VoxReader& reader) {
        const std::int32_t id = reader.number();
        if (valueOf(reader.dictionary(), "_hidden") == "1") hiddenLayers_.insert(id);
    }

    void readNode(std::string_view kind, VoxReader& reader) {
        const std::int32_t id = reader.number();
        const VoxDictionary attributes = reader.dictionary();
        VoxNode node;
        node.isHidden = valueOf(attributes, "_hidden") == "1";
        if (kind == "nTRN") {
            node.kind = VoxNode::Kind::Transform;
            node.children.push_back(reader.number());
            reader.number();  // reserved
            node.layer = reader.number();
            if (reader.count() > 0) {
                const VoxDictionary frame = reader.dictionary();
                const auto rotation = rotationOf(valueOf(frame, "_r"));
                if (!rotation) problem_ = "a rotation is wrong";
                if (rotation) node.transform = *rotation;
                const auto step = stepOf(valueOf(frame, "_t"));
                if (!step) problem_ = "a translation is no position within 2^20 blocks";
                if (step) node.transform.step = *step;
            }
        } else {
            node.kind = kind == "nGRP" ? VoxNode::Kind::Group : VoxNode::Kind::Shape;
            readChildren(reader, node, kind == "nSHP");
        }
        if (parts_.nodes.size() == kMaxVoxNodes) problem_ = "it has too many nodes";
        parts_.nodes[id] = std::move(node);
    }

    VoxParts parts_;
    std::unordered_set<std::int32_t> hiddenLayers_;
    glm::ivec3 size_{0};
    std::string problem_;
};

}  // namespace

base::Result<VoxParts> readVoxParts(std::string_view bytes) {
    return VoxPartsReader().read(bytes);
}

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
