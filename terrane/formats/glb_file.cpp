#include "terrane/formats/glb_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <string_view>

namespace terrane::formats {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

// Values of the format (Khronos, glTF 2.0 specification, 5.).
constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kVertexTarget = 34962, kIndexTarget = 34963;
constexpr int kNearest = 9728, kNearestMipmapLinear = 9986, kRepeat = 10497;
constexpr std::uint32_t kGlbMagic = 0x46546C67, kGlbJson = 0x4E4F534A, kGlbBinary = 0x004E4942;
constexpr std::array<const char*, 3> kAlphaNames{"OPAQUE", "MASK", "BLEND"};

std::size_t padded(std::size_t bytes) {
    return (bytes + 3) / 4 * 4;
}

json vectorOf(glm::vec3 v) {
    return json::array({v.x, v.y, v.z});
}

// Builds the binary part and the JSON that describes it: first all vertices, then all indices, then images.
class GlbWriter {
  public:
    explicit GlbWriter(const GlbModel& model) : model_(model) {}

    std::size_t binaryBytes() const {
        std::size_t bytes = 0;
        for (const GlbPart& part : model_.parts)
            bytes += part.vertices.size() * sizeof(GlbVertex) + part.indices.size() * sizeof(std::uint32_t);
        for (const GlbImage& image : model_.images) bytes += padded(image.png.size());
        return bytes;
    }

    std::string write() {
        binary_.reserve(binaryBytes());
        writeVertices();
        writeIndices();
        writeImages();
        writeMaterials();
        writeScene();
        return file();
    }

  private:
    template <class T>
    static std::string_view bytesOf(const std::vector<T>& values) {
        return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
    }

    // Adds a view of all bytes that were appended since `first`.
    std::size_t addView(std::size_t first, const json& more) {
        json view = {{"buffer", 0}, {"byteOffset", first}, {"byteLength", binary_.size() - first}};
        view.update(more);
        json_["bufferViews"].push_back(view);
        return json_["bufferViews"].size() - 1;
    }

    std::size_t addAccessor(const json& accessor) {
        json_["accessors"].push_back(accessor);
        return json_["accessors"].size() - 1;
    }

    void addVertexAccessors(const GlbPart& part, std::size_t offset) {
        glm::vec3 low = part.vertices[0].position, high = low;
        for (const GlbVertex& vertex : part.vertices) {
            low = glm::min(low, vertex.position);
            high = glm::max(high, vertex.position);
        }
        const auto accessor = [&](std::size_t member, const char* type) {
            return json{{"bufferView", 0},
                        {"byteOffset", offset + member},
                        {"componentType", kFloat},
                        {"count", part.vertices.size()},
                        {"type", type}};
        };
        json position = accessor(offsetof(GlbVertex, position), "VEC3");
        position["min"] = vectorOf(low);
        position["max"] = vectorOf(high);
        json attributes;
        attributes["POSITION"] = addAccessor(position);
        attributes["NORMAL"] = addAccessor(accessor(offsetof(GlbVertex, normal), "VEC3"));
        attributes["TEXCOORD_0"] = addAccessor(accessor(offsetof(GlbVertex, uv), "VEC2"));
        const std::size_t material = primitives_.size();
        primitives_.push_back({{"attributes", attributes}, {"material", material}, {"mode", 4}});
    }

    void writeVertices() {
        for (const GlbPart& part : model_.parts) {
            addVertexAccessors(part, binary_.size());
            binary_ += bytesOf(part.vertices);
        }
        addView(0, {{"byteStride", sizeof(GlbVertex)}, {"target", kVertexTarget}});
    }

    void writeIndices() {
        const std::size_t first = binary_.size();
        for (std::size_t k = 0; k < model_.parts.size(); ++k) {
            const std::vector<std::uint32_t>& indices = model_.parts[k].indices;
            primitives_[k]["indices"] = addAccessor({{"bufferView", 1},
                                                     {"byteOffset", binary_.size() - first},
                                                     {"componentType", kUnsignedInt},
                                                     {"count", indices.size()},
                                                     {"type", "SCALAR"}});
            binary_ += bytesOf(indices);
        }
        addView(first, {{"target", kIndexTarget}});
    }

    void writeImages() {
        json_["samplers"] = json::array({{{"magFilter", kNearest},
                                          {"minFilter", kNearestMipmapLinear},
                                          {"wrapS", kRepeat},
                                          {"wrapT", kRepeat}}});
        for (std::size_t k = 0; k < model_.images.size(); ++k) {
            const GlbImage& image = model_.images[k];
            const std::size_t first = binary_.size();
            binary_ += image.png;
            const std::size_t view = addView(first, json::object());
            binary_.resize(padded(binary_.size()));
            json_["images"].push_back(
                {{"name", image.name}, {"mimeType", "image/png"}, {"bufferView", view}});
            json_["textures"].push_back({{"sampler", 0}, {"source", k}});
        }
    }

    void writeMaterials() {
        for (const GlbPart& part : model_.parts) {
            json material = {{"name", part.name},
                             {"alphaMode", kAlphaNames[static_cast<std::size_t>(part.alpha)]},
                             {"doubleSided", part.isTwoSided},
                             {"pbrMetallicRoughness",
                              {{"baseColorTexture", {{"index", part.image}}},
                               {"metallicFactor", 0},
                               {"roughnessFactor", 1}}}};
            if (part.alpha == GlbAlpha::Mask) material["alphaCutoff"] = 0.5;
            if (part.glow >= 0) {
                material["emissiveTexture"] = {{"index", part.glow}};
                material["emissiveFactor"] = {1, 1, 1};
            }
            json_["materials"].push_back(material);
        }
    }

    void writeScene() {
        json_["asset"] = {{"version", "2.0"}, {"generator", "Terrane"}};
        json_["meshes"] = json::array({{{"name", model_.name}, {"primitives", primitives_}}});
        json_["nodes"] = json::array({{{"name", model_.name}, {"mesh", 0}}});
        json_["scenes"] = json::array({{{"nodes", {0}}}});
        json_["scene"] = 0;
        json_["buffers"] = json::array({{{"byteLength", binary_.size()}}});
    }

    static void appendWord(std::string& bytes, std::size_t value) {
        for (unsigned k = 0; k < 4; ++k) bytes.push_back(static_cast<char>(value >> (8 * k)));
    }

    std::string file() const {
        std::string text = json_.dump(-1, ' ', false, json::error_handler_t::replace);
        text.resize(padded(text.size()), ' ');
        std::string bytes;
        bytes.reserve(text.size() + binary_.size() + 28);
        appendWord(bytes, kGlbMagic);
        appendWord(bytes, 2);
        appendWord(bytes, 28 + text.size() + binary_.size());
        appendWord(bytes, text.size());
        appendWord(bytes, kGlbJson);
        bytes += text;
        appendWord(bytes, binary_.size());
        appendWord(bytes, kGlbBinary);
        bytes += binary_;
        return bytes;
    }

    const GlbModel& model_;
    json json_;
    std::vector<json> primitives_;
    std::string binary_;
};

}  // namespace

base::Result<std::string> encodeGlb(const GlbModel& model) {
    GlbWriter writer(model);
    const auto isEmpty = [](const GlbPart& part) { return part.vertices.empty() || part.indices.empty(); };
    if (model.parts.empty() || std::ranges::any_of(model.parts, isEmpty))
        return base::fail(base::ErrorCode::BadInput, ".glb: a model has parts, and each of them triangles");
    // The JSON takes about 1 KiB a material.
    const std::size_t bytes = writer.binaryBytes() + model.parts.size() * 4096;
    if (bytes >= UINT32_MAX)
        return base::fail(base::ErrorCode::OutOfResources, ".glb: {} bytes are more than a file has", bytes);
    return writer.write();
}

}  // namespace terrane::formats
