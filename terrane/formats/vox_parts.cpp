// Reads the chunks of a .vox file.
#include <charconv>
#include <optional>

#include "terrane/formats/vox_scene_internal.h"

namespace terrane::formats {
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

// Reads "x y z", 0 for missing numbers. Steps are clamped to 2^20 blocks, so that sums of nested ones fit an
// int.
glm::ivec3 stepOf(std::string_view text) {
    constexpr int kFarthest = 1 << 20;
    glm::ivec3 step(0);
    const char *at = text.data(), *end = text.data() + text.size();
    for (int axis = 0; axis < 3; ++axis) {
        while (at != end && *at == ' ') ++at;
        int value = 0;
        const auto [after, bad] = std::from_chars(at, end, value);
        if (bad != std::errc()) break;
        step[axis] = value < -kFarthest ? -kFarthest : value > kFarthest ? kFarthest : value;
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

    void readNode(std::string_view kind, VoxReader& reader) {
        const std::int32_t id = reader.number();
        const VoxDictionary attributes = reader.dictionary();
        VoxNode node;
        node.isHidden = valueOf(attributes, "_hidden") == "1";
        if (kind == "nTRN") {
            node.kind = VoxNode::Kind::Transform;
            node.children.push_back(reader.number());
            reader.take(8);  // reserved, layer
            if (reader.count() > 0) {
                const VoxDictionary frame = reader.dictionary();
                const auto rotation = rotationOf(valueOf(frame, "_r"));
                if (!rotation) problem_ = "a rotation is wrong";
                if (rotation) node.transform = *rotation;
                node.transform.step = stepOf(valueOf(frame, "_t"));
            }
        } else {
            node.kind = kind == "nGRP" ? VoxNode::Kind::Group : VoxNode::Kind::Shape;
            readChildren(reader, node, kind == "nSHP");
        }
        if (parts_.nodes.size() == kMaxVoxNodes) problem_ = "it has too many nodes";
        parts_.nodes[id] = std::move(node);
    }

    VoxParts parts_;
    glm::ivec3 size_{0};
    std::string problem_;
};

}  // namespace

base::Result<VoxParts> readVoxParts(std::string_view bytes) {
    return VoxPartsReader().read(bytes);
}

}  // namespace terrane::formats
