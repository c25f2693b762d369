// Blocks whose shape is quads, drawn.
#include <optional>

#include "terrane/mesh/chunk_mesher.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

// A red texture with a white upper left quarter.
base::Result<base::Image> quarterTexture(std::string_view) {
    base::Image image{16, 16, {}};
    for (int k = 0; k < 16 * 16; ++k) {
        const bool isWhite = k % 16 < 8 && k / 16 < 8;
        const std::uint8_t other = isWhite ? 255 : 0;
        image.rgba.insert(image.rgba.end(), {255, other, other, 255});
    }
    return image;
}

// Shapes by name; the block of each has the same name.
struct NamedShape {
    std::string_view name, keys;
};
constexpr NamedShape kShapes[] = {
    {"box", "boxes = [[2, 3, 0, 14, 12, 9]]"},
    {"lower_box", "boxes = [[2, 3, 0, 14, 12, 8]]"},
    {"sides", R"(quads = [
        { corners = [[2, 12, 0], [2, 3, 0], [2, 3, 9], [2, 12, 9]] },
        { corners = [[14, 3, 0], [14, 12, 0], [14, 12, 9], [14, 3, 9]] },
        { corners = [[2, 3, 0], [14, 3, 0], [14, 3, 9], [2, 3, 9]], uv = [[2, 16], [14, 16], [14, 7], [2, 7]] },
        { corners = [[14, 12, 0], [2, 12, 0], [2, 12, 9], [14, 12, 9]] },
        { corners = [[2, 12, 0], [14, 12, 0], [14, 3, 0], [2, 3, 0]] },
        { corners = [[2, 3, 9], [14, 3, 9], [14, 12, 9], [2, 12, 9]] },
    ])"},
    {"upright",
     "quads = [{ corners = [[0, 8, 0], [16, 8, 0], [16, 8, 16], [0, 8, 16]], "
     "uv = [[0, 16], [16, 16], [16, 0], [0, 0]] }]"},
    {"turned",
     "quads = [{ corners = [[0, 8, 0], [16, 8, 0], [16, 8, 16], [0, 8, 16]], "
     "uv = [[16, 16], [16, 0], [0, 0], [0, 16]] }]"},
    {"quarter",
     "quads = [{ corners = [[0, 8, 0], [16, 8, 0], [16, 8, 16], [0, 8, 16]], "
     "uv = [[0, 8], [8, 8], [8, 0], [0, 0]] }]"},
    {"two_sided",
     "quads = [{ corners = [[0, 8, 0], [16, 8, 0], [16, 8, 16], [0, 8, 16]], "
     "uv = [[0, 8], [8, 8], [8, 0], [0, 0]], two_sided = true }]"},
    {"triangle",
     "quads = [{ corners = [[0, 8, 0], [16, 8, 0], [0, 8, 16], [0, 8, 16]], "
     "uv = [[0, 4], [4, 4], [0, 0], [0, 0]] }]"},
};

class ShapeQuads : public RendererTest {
  protected:
    void SetUp() override {
        RendererTest::SetUp();
        if (IsSkipped()) return;
        std::string text;
        for (const NamedShape& shape : kShapes)
            text += fmt::format(
                "[[shape]]\nname = \"{0}\"\n{1}\n[[block]]\nname = \"{0}\"\nshape = \"{0}\"\n"
                "texture = \"quarter\"\nopacity = 0\n",
                shape.name, shape.keys);
        auto parsed = world::BlockRegistry::parse(text, "test");
        ASSERT_TRUE(parsed) << parsed.error().message;
        blocks_ = std::move(*parsed);
        gpu::DeviceInfo device = gpu::queryDevice();
        device.software = true;  // no anisotropic filter: drivers may filter as they like
        auto made = Renderer::create(contentShaders(), blocks_, quarterTexture, device);
        ASSERT_TRUE(made) << made.error().message;
        own_ = std::move(*made);
        ASSERT_TRUE(own_->configure({96, 96}, plainOptions(1)));
    }

    // The block of a shape, or nothing, alone in the air.
    base::Image draw(std::string_view name, const Camera& camera) {
        world::Chunk chunk;
        if (!name.empty()) chunk.setBlock(world::blockIndex(8, 8, 100), blocks_.find(name)->id);
        EXPECT_TRUE(own_->setChunk({0, 0}, mesh::meshAlone(chunk, blocks_)));
        own_->draw(noon(camera));
        return own_->readImage();
    }

    world::BlockRegistry blocks_;
    std::optional<Renderer> own_;
};

TEST_F(ShapeQuads, ABoxAndItsSidesAsQuadsAreTheSameImage) {
    for (const Camera& camera : {Camera{{8.1, 6.6, 101.3}, 80, -35}, Camera{{9.6, 10.4, 99.2}, 235, 25}}) {
        const base::Image box = draw("box", camera);
        EXPECT_EQ(box.rgba, draw("sides", camera).rgba);
        EXPECT_NE(box.rgba, draw("lower_box", camera).rgba);
    }
}

// The color at a share of the image's width and height from its upper left corner.
Color colorAt(const base::Image& image, double x, double y) {
    return pixel(image, static_cast<int>(x * image.width), static_cast<int>(y * image.height));
}
bool isWhiteAt(const base::Image& image, double x, double y) {
    const Color color = colorAt(image, x, y);
    return color[1] > color[0] / 2;
}

const Camera kBeforePlane{{8.5, 7.6, 100.5}, 90, 0}, kBehindPlane{{8.5, 9.4, 100.5}, 270, 0};

TEST_F(ShapeQuads, ShowTheTextureByTheirOwnCoordinates) {
    const base::Image upright = draw("upright", kBeforePlane);
    EXPECT_TRUE(isWhiteAt(upright, 0.35, 0.35));
    EXPECT_FALSE(isWhiteAt(upright, 0.65, 0.35));
    EXPECT_FALSE(isWhiteAt(upright, 0.35, 0.65));
    const base::Image turned = draw("turned", kBeforePlane);
    EXPECT_FALSE(isWhiteAt(turned, 0.35, 0.35));
    EXPECT_TRUE(isWhiteAt(turned, 0.65, 0.35));
    const base::Image quarter = draw("quarter", kBeforePlane);
    for (const double x : {0.35, 0.65})
        for (const double y : {0.35, 0.65}) EXPECT_TRUE(isWhiteAt(quarter, x, y));
}

TEST_F(ShapeQuads, ATriangleHasOneCornerLess) {
    const base::Image triangle = draw("triangle", kBeforePlane), sky = draw("", kBeforePlane);
    EXPECT_TRUE(isWhiteAt(triangle, 0.35, 0.65));
    EXPECT_NE(colorAt(triangle, 0.35, 0.65), colorAt(sky, 0.35, 0.65));
    EXPECT_EQ(colorAt(triangle, 0.7, 0.3), colorAt(sky, 0.7, 0.3));
}

TEST_F(ShapeQuads, OnlyTwoSidedOnesAreSeenFromBehind) {
    EXPECT_EQ(draw("quarter", kBeforePlane).rgba, draw("two_sided", kBeforePlane).rgba);
    EXPECT_EQ(draw("quarter", kBehindPlane).rgba, draw("", kBehindPlane).rgba);
    EXPECT_NE(draw("two_sided", kBehindPlane).rgba, draw("", kBehindPlane).rgba);
}

}  // namespace
}  // namespace terrane::render
