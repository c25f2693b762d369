// Proof that the golden images detect errors: the test makes each error on purpose, and the comparison must
// fail.
#include <array>
#include <set>
#include <string_view>
#include <vector>

#include "tests/golden/axes_cube.h"
#include "tests/golden/golden_fixture.h"
#include "tests/support/depth.h"

namespace terrane::golden {
namespace {

class GoldenProof : public GoldenTest {
  protected:
    static constexpr std::size_t kGalleries = 5;

    base::Image drawOne(std::size_t gallery, const render::TextureSource& textures) {
        if (!renderer_) renderer_ = makeRenderer(textures);
        const auto set = renderer_->setTextures(contentBlocks(), textures);
        if (!set) throw std::runtime_error(set.error().message);
        renderer_->clearChunks();
        switch (gallery) {
            case 0:
                return drawGallery(*renderer_, galleryOnGround(), kAbove);
            case 1:
                return drawGallery(*renderer_, galleryInTheAir(), kBelow);
            case 2:
                return drawGallery(*renderer_, galleryOf(kLandGallery), kLand);
            case 3:
                return drawGallery(*renderer_, galleryOf(kCubesGallery), kLand);
            default:
                return drawGallery(*renderer_, galleryOf(kShapesGallery), kShapes);
        }
    }

    using Images = std::array<base::Image, kGalleries>;

    Images drawAll(const render::TextureSource& textures) {
        Images images;
        for (std::size_t k = 0; k < kGalleries; ++k) images[k] = drawOne(k, textures);
        return images;
    }

    // Whether one of the galleries shows other textures. Starts with the gallery that detected the last
    // change.
    bool isNoticed(const Images& right, const render::TextureSource& textures) {
        for (std::size_t k = 0; k < kGalleries; ++k) {
            const std::size_t gallery = (lastNoticed_ + k) % kGalleries;
            if (isSame(right[gallery], drawOne(gallery, textures))) continue;
            lastNoticed_ = gallery;
            return true;
        }
        return false;
    }

    base::Image drawCube(const render::TextureSource& textures, const render::Camera& camera) {
        render::Renderer renderer = makeRenderer(textures, cubeBlocks());
        renderer.setChunk({0, 0}, cubeMesh());
        return draw(renderer, cubeFrame(camera));
    }

  private:
    std::optional<render::Renderer> renderer_;  // of textures that are replaced
    std::size_t lastNoticed_ = 0;
};

constexpr std::string_view kGalleryNames[] = {kFirstGallery, kLandGallery, kCubesGallery, kShapesGallery};

// The textures that the galleries show, in the order of the registry.
std::vector<std::string> galleryTextures() {
    std::set<std::uint16_t> textures;
    for (const std::string_view gallery : kGalleryNames) {
        for (const world::BlockType* type : galleryTypes(gallery)) {
            for (const auto number : type->material)
                textures.insert(contentBlocks().materials()[number].texture);
            for (const auto number : type->growth)
                textures.insert(contentBlocks().materials()[number].texture);
        }
    }
    std::vector<std::string> names;
    for (const std::uint16_t texture : textures) names.push_back(contentBlocks().textures()[texture]);
    return names;
}

// Content with one texture replaced by another.
render::TextureSource replaced(std::string_view name, std::string_view by) {
    return [=](std::string_view wanted) { return render::contentTexture(wanted == name ? by : wanted); };
}

render::TextureSource swapped(std::string_view a, std::string_view b) {
    return [=](std::string_view wanted) {
        return render::contentTexture(wanted == a ? b : wanted == b ? a : wanted);
    };
}

TEST_F(GoldenProof, TheSameIsTheSame) {
    const Images right = drawAll(render::contentTexture);
    EXPECT_FALSE(isNoticed(right, render::contentTexture));
    EXPECT_EQ(difference(right[0], drawOne(0, render::contentTexture)).max, 0);
}

TEST_F(GoldenProof, AnyWrongTextureIsNoticed) {
    const Images right = drawAll(render::contentTexture);
    const std::vector<std::string> names = galleryTextures();
    for (std::size_t k = 0; k < names.size(); k += atDepth<std::size_t>(7, 1)) {
        const std::string& other = names[(k + 1) % names.size()];
        EXPECT_TRUE(isNoticed(right, replaced(names[k], other))) << other << " for " << names[k];
    }
}

// A block that looks like no other one so far belongs into a gallery.
TEST_F(GoldenProof, GalleriesShowEveryShapeAlphaAndAnimation) {
    using Kinds = std::set<std::array<int, 2>>;
    const auto addKinds = [](Kinds& kinds, const world::BlockType& type) {
        kinds.insert({0, int{static_cast<std::uint8_t>(type.shape)}});
        for (const std::uint16_t number : type.material) {
            const world::Material& material = contentBlocks().materials()[number];
            kinds.insert({1, int{static_cast<std::uint8_t>(material.alpha)}});
            kinds.insert({2, int{static_cast<std::uint8_t>(material.animation)}});
        }
    };
    Kinds all, shown;
    for (const world::BlockType& type : contentBlocks().types()) {
        if (type.id != world::kAir) addKinds(all, type);
    }
    for (const std::string_view gallery : kGalleryNames) {
        for (const world::BlockType* type : galleryTypes(gallery)) addKinds(shown, *type);
    }
    EXPECT_EQ(all, shown);
}

TEST_F(GoldenProof, SwappedSidesAreNoticed) {
    const Images right = drawAll(render::contentTexture);
    for (const auto& [a, b] : {std::pair("oak_log_top", "oak_log_side"),
                               {"grass_top", "grass_side"},
                               {"cactus_top", "cactus_side"},
                               {"cactus_top", "cactus_bottom"}}) {
        EXPECT_TRUE(isNoticed(right, swapped(a, b))) << a << " and " << b;
    }
}

void dropDirection(mesh::ChunkMesh& mesh, int bucket, int direction) {
    mesh::ChunkMesh rest;
    for (const mesh::MeshSection& meshSection : mesh.meshSections) {
        mesh::MeshSection& kept = rest.meshSections.emplace_back(meshSection);
        for (int c = 0; c < mesh::kDrawBucketCount; ++c) {
            for (int g = 0; g < mesh::kFaceDirectionCount; ++g) {
                const mesh::QuadRange from = meshSection.ranges[c][g];
                const std::uint32_t count = c == bucket && g == direction ? 0 : from.count;
                kept.ranges[c][g] = {static_cast<std::uint32_t>(rest.quads.size()), count};
                const auto first = mesh.quads.begin() + from.first;
                rest.quads.insert(rest.quads.end(), first, first + count);
            }
        }
    }
    mesh = std::move(rest);
}

bool hasDirection(const Meshes& meshes, int bucket, int direction) {
    return std::ranges::any_of(meshes, [&](const auto& entry) {
        return std::ranges::any_of(entry.second.meshSections, [&](const mesh::MeshSection& meshSection) {
            return meshSection.ranges[bucket][direction].count > 0;
        });
    });
}

// Faces that look away may be dropped: the draw list drops them too.
TEST_F(GoldenProof, AMissingDirectionIsNoticedWhereItIsSeen) {
    const Meshes right = galleryOnGround();
    render::Renderer& renderer = emptyRenderer();
    const base::Image expected = drawGallery(renderer, right, kAbove);
    int noticed = 0;
    for (int bucket = 0; bucket < mesh::kDrawBucketCount; ++bucket) {
        for (int direction = 0; direction < mesh::kFaceDirectionCount; ++direction) {
            if (!hasDirection(right, bucket, direction)) continue;
            Meshes wrong = right;
            for (auto& [pos, mesh] : wrong) dropDirection(mesh, bucket, direction);
            const bool looksAway = direction == world::kFacePosX || direction == world::kFacePosY ||
                                   direction == world::kFaceNegZ;
            EXPECT_EQ(isSame(expected, drawGallery(renderer, wrong, kAbove)), looksAway)
                << "bucket " << bucket << ", direction " << direction;
            noticed += !looksAway;
        }
    }
    EXPECT_GE(noticed, 5) << "opaque -x, -y, +z, tested and blended on both sides";
}

struct QuadPlace {
    std::size_t meshSection;
    int bucket, direction;
    std::uint32_t number;
};

std::vector<QuadPlace> quadsSeenFromBelow(const mesh::ChunkMesh& mesh) {
    std::vector<QuadPlace> places;
    for (std::size_t r = 0; r < mesh.meshSections.size(); ++r) {
        for (int bucket = 0; bucket < mesh::kDrawBucketCount; ++bucket) {
            for (const int direction :
                 {int{world::kFacePosX}, int{world::kFacePosY}, int{world::kFaceNegZ}}) {
                const mesh::QuadRange range = mesh.meshSections[r].ranges[bucket][direction];
                for (std::uint32_t k = 0; k < range.count; ++k)
                    places.push_back({r, bucket, direction, range.first + k});
            }
        }
    }
    return places;
}

void dropQuad(mesh::ChunkMesh& mesh, const QuadPlace& place) {
    mesh.quads.erase(mesh.quads.begin() + static_cast<std::ptrdiff_t>(place.number));
    for (mesh::MeshSection& meshSection : mesh.meshSections) {
        for (auto& bucket : meshSection.ranges) {
            for (mesh::QuadRange& range : bucket) range.first -= range.first > place.number ? 1u : 0u;
        }
    }
    --mesh.meshSections[place.meshSection].ranges[place.bucket][place.direction].count;
}

TEST_F(GoldenProof, AnyMissingFaceIsNoticed) {
    const Meshes right = galleryInTheAir();
    render::Renderer& renderer = emptyRenderer();
    const base::Image expected = drawGallery(renderer, right, kBelow);
    const std::vector<QuadPlace> places = quadsSeenFromBelow(right.at({0, 0}));
    EXPECT_GE(places.size(), 3u * 11u);
    for (const QuadPlace& place : places) {
        Meshes wrong = right;
        dropQuad(wrong.at({0, 0}), place);
        EXPECT_FALSE(isSame(expected, drawGallery(renderer, wrong, kBelow)))
            << "quad " << place.number << " of direction " << place.direction;
    }
}

// The image with its columns, rows or both in reverse order.
base::Image turned(const base::Image& image, bool flipX, bool flipY) {
    base::Image result = image;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const int fromX = flipX ? image.width - 1 - x : x, fromY = flipY ? image.height - 1 - y : y;
            std::copy_n(image.rgba.begin() + 4 * (fromX + fromY * image.width), 4,
                        result.rgba.begin() + 4 * (x + y * image.width));
        }
    }
    return result;
}

base::Image transposed(const base::Image& image) {
    base::Image result = image;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            std::copy_n(image.rgba.begin() + 4 * (y + x * image.width), 4,
                        result.rgba.begin() + 4 * (x + y * image.width));
        }
    }
    return result;
}

TEST_F(GoldenProof, AMirroredImageIsNoticed) {
    for (const render::Camera& camera : {kCubeNegative, kCubePositive}) {
        const base::Image right = drawCube(cubeTexture, camera);
        EXPECT_FALSE(isSame(right, turned(right, true, false)));
        EXPECT_FALSE(isSame(right, turned(right, false, true)));
        EXPECT_FALSE(isSame(right, turned(right, true, true)));
    }
}

TEST_F(GoldenProof, TurnedTexturesAreNoticedOnEverySide) {
    using Change = std::function<base::Image(const base::Image&)>;
    const Change changes[] = {[](const base::Image& i) { return turned(i, true, false); },
                              [](const base::Image& i) { return turned(i, false, true); },
                              [](const base::Image& i) { return turned(i, true, true); }, transposed};
    const base::Image negative = drawCube(cubeTexture, kCubeNegative),
                      positive = drawCube(cubeTexture, kCubePositive);
    for (const std::string_view side : kSideNames) {
        for (const Change& change : changes) {
            const auto wrong = [&](std::string_view name) -> base::Result<base::Image> {
                const auto image = cubeTexture(name);
                return name == side ? change(*image) : *image;
            };
            EXPECT_FALSE(isSame(negative, drawCube(wrong, kCubeNegative)) &&
                         isSame(positive, drawCube(wrong, kCubePositive)))
                << side;
        }
    }
}

TEST_F(GoldenProof, SwappedAxesAreNoticed) {
    const base::Image negative = drawCube(cubeTexture, kCubeNegative),
                      positive = drawCube(cubeTexture, kCubePositive);
    for (std::size_t a = 0; a < kSideNames.size(); ++a) {
        for (std::size_t b = a + 1; b < kSideNames.size(); ++b) {
            const auto wrong = [=](std::string_view name) {
                return cubeTexture(name == kSideNames[a]   ? kSideNames[b]
                                   : name == kSideNames[b] ? kSideNames[a]
                                                           : name);
            };
            EXPECT_FALSE(isSame(negative, drawCube(wrong, kCubeNegative)) &&
                         isSame(positive, drawCube(wrong, kCubePositive)))
                << kSideNames[a] << " and " << kSideNames[b];
        }
    }
}

// Frames from a little closer, an hour later, or a little brighter.
TEST_F(GoldenProof, OtherFramesAreNoticed) {
    render::Renderer& renderer = emptyRenderer();
    const Meshes meshes = galleryOnGround();
    const base::Image right = drawGallery(renderer, meshes, kAbove);
    render::Camera closer = kAbove;
    closer.position += glm::dvec3(render::lookDirection(closer)) * 0.25;
    EXPECT_FALSE(isSame(right, drawGallery(renderer, meshes, closer)));
    render::FrameInput input{kAbove, world::environmentAt(0.34f + 1.0f / 24), 400, 0, render::View::Color};
    EXPECT_FALSE(isSame(right, draw(renderer, input)));
    input.environment = world::environmentAt(0.34f);
    EXPECT_TRUE(isSame(right, draw(renderer, input)));
    input.environment.lightColor *= 1.05f;
    EXPECT_FALSE(isSame(right, draw(renderer, input)));
}

}  // namespace
}  // namespace terrane::golden
