// Renders the golden images: the same scenes for the comparison and for the proof that it detects errors.
#pragma once

#include "tests/golden/golden.h"
#include "tests/golden/scenes.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/render/shared_renderer.h"

namespace terrane::golden {

constexpr glm::ivec2 kImageSize{320, 180};
constexpr int kSamples = 4;

// The view from above shows the sides -x, -y and +z of the gallery, the one from below the others.
inline const render::Camera kAbove{{0.6, -6.2, 89.9}, 59, -38.5, 37};
inline const render::Camera kLand{{0.2, -7.4, 92.2}, 61.5, -43, 33};
inline const render::Camera kShapes{{0, -9.4, 94.2}, 60.5, -40, 36};
inline const render::Camera kBelow{{14.3, 12.2, 72.9}, 229.0, 39.5, 33};

class GoldenTest : public gpu::GlTest {
  private:
    static gpu::DeviceInfo device() {
        gpu::DeviceInfo device = gpu::queryDevice();
        device.software = true;  // no anisotropic filter, which differs by driver
        // Edges are expanded for the subpixel grid of the driver that made the images. Coarser grids (OpenGL
        // 4.5, table 23.55: 4 bits or more) expand them further; tests/render/edge_expansion_test.cpp covers
        // that.
        device.subpixelBits = 8;
        return device;
    }
    static void configure(render::Renderer& renderer) {
        const int samples = std::min(kSamples, gpu::queryDevice().maxSamples);
        const auto configured = renderer.configure(kImageSize, render::plainOptions(samples));
        if (!configured) throw std::runtime_error(configured.error().message);
    }

  protected:
    // The shared renderer, empty and configured.
    static render::Renderer& emptyRenderer() {
        render::Renderer& renderer = render::emptyRenderer(device());
        configure(renderer);
        return renderer;
    }
    // A renderer of other blocks or textures.
    static render::Renderer makeRenderer(const render::TextureSource& textures,
                                         const world::BlockRegistry& blocks = contentBlocks()) {
        auto made = render::Renderer::create(render::contentShaders(), blocks, textures, device());
        if (!made) throw std::runtime_error(made.error().message);
        configure(*made);
        return *std::move(made);
    }

    static base::Image draw(render::Renderer& renderer, const render::FrameInput& input) {
        renderer.draw(input);
        return renderer.readImage();
    }

    // Draws by lists and by a loop, which must be the same. The second and the third frame are compared:
    // quads that the frame before showed are drawn first. Their edges do not grow: which of two quads over
    // the same edge is drawn first differs from run to run.
    static base::Image drawBothWays(render::Renderer& renderer, const render::FrameInput& input) {
        const base::Image image = draw(renderer, input);
        const render::RenderOptions options = renderer.options();
        const auto drawBy = [&](render::DrawMethod method) {
            render::RenderOptions changed = options;
            changed.draw = method;
            changed.tJunctions = render::TJunctions::Open;
            changed.shadows = render::ShadowReach::Off;  // the next frame draws all shadows again
            EXPECT_TRUE(renderer.configure(renderer.size(), changed));
            changed.shadows = options.shadows;
            EXPECT_TRUE(renderer.configure(renderer.size(), changed));
            return draw(renderer, input);
        };
        const base::Image lists = drawBy(render::DrawMethod::Indirect);
        EXPECT_TRUE(lists.rgba == drawBy(render::DrawMethod::Loop).rgba) << "a loop draws another image";
        EXPECT_TRUE(renderer.configure(renderer.size(), options));
        return image;
    }

    static render::FrameInput galleryFrame(const render::Camera& camera) {
        return {camera, world::environmentAt(0.34f), 400, 0, render::View::Color};
    }

    static base::Image drawGallery(render::Renderer& renderer, const Meshes& meshes,
                                   const render::Camera& camera) {
        for (const auto& [pos, mesh] : meshes) renderer.setChunk(pos, mesh);
        return draw(renderer, galleryFrame(camera));
    }

    static Meshes galleryOnGround() {
        world::World world = flatWorld(4);
        placeGallery(world);
        return meshWorld(world);
    }
    static Meshes galleryOf(std::string_view gallery) {
        world::World world = flatWorld(3);
        placeGallery(world, gallery);
        return meshWorld(world);
    }
    static Meshes galleryInTheAir() {
        world::World world = emptyWorld(1);
        placeGallery(world);
        return meshWorld(world);
    }
};

}  // namespace terrane::golden
