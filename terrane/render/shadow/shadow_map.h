// Shadow maps of the sun or moon around the camera, in cascades (shadow_clipmap.h) that persist from frame to
// frame: only tiles that came into reach, or whose casters changed, are drawn. The renderer uses it on the
// context's thread.
#pragma once

#include "terrane/gpu/framebuffer.h"
#include "terrane/gpu/mapped_ring.h"
#include "terrane/gpu/pipeline_state.h"
#include "terrane/gpu/texture.h"
#include "terrane/render/figures/figure_pass.h"
#include "terrane/render/figures/figure_shadows.h"
#include "terrane/render/quads/mesh_section_table.h"
#include "terrane/render/quads/quad_resources.h"
#include "terrane/render/shadow/shadow_casters.h"

namespace terrane::render {

struct ShadowPrograms {
    const gpu::Program *opaque, *tested, *figures;
};

class ShadowMap {
  public:
    struct Shape {
        int cascades = 1;
        int texels = 1024;  // along a side of each map; a multiple of kShadowTiles

        bool operator==(const Shape&) const = default;
    };
    static base::Result<ShadowMap> create(const Shape& shape);
    const Shape& shape() const { return shape_; }

    // Marks the tiles of changed casters.
    void markChanged(std::span<const CasterBox> boxes);
    // Marks all tiles to be drawn again, after casters have changed their look.
    void invalidate() {
        clipmap_ = ShadowClipmap(shape_.cascades);
        figureShadows_.invalidate();
    }

    struct Casters {
        QuadResources& resources;
        const QuadStore& quads;
        const MeshSectionTable& meshSections;                  // up to date
        std::uint32_t maxCommands = shared::kMaxDrawCommands;  // that are uploaded at once
    };
    // Draws up to `maxTiles` missing or changed tiles.
    void update(gpu::Pipeline& pipeline, const Casters& casters, const ShadowPrograms& programs,
                const Camera& camera, glm::vec3 lightDirection, std::size_t maxTiles);

    struct FigureCasters {
        std::span<const shared::FigureRecord> records;  // within kFigureShadowReach
        world::ChunkPos chunk;                          // of the camera
    };
    static constexpr std::size_t kFigureRingBytes = 1024;  // of the ring, for four rectangles
    // Comes after each update(): adds the shadows of figures to the nearest cascade, with the frame's
    // uniforms bound. The first figure adds a layer to the maps.
    void drawFigures(gpu::Pipeline& pipeline, const FigurePass& pass, const ShadowPrograms& programs,
                     const FigureCasters& figures, gpu::MappedRing& ring);

    // Comes after update(), for a frame from the camera. `isLit` is false without light that casts shadows;
    // then update() is not needed.
    void writeUniforms(const Camera& camera, bool isLit, gpu::MappedRing& ring) const;
    void addTo(gpu::TextureSet& textures) const;

    std::size_t drawnTriangles() const { return drawnTriangles_; }  // by the last update()
    std::size_t gpuBytes() const { return depths_.sizeBytes(); }

  private:
    struct Drawing {
        ShadowTiles tiles;
        std::vector<CasterList> lists;
    };
    std::vector<Drawing> prepare(const std::vector<ShadowTiles>& tiles, const MeshSectionTable& meshSections);
    std::size_t uploadRecords(std::span<Drawing> drawings, std::uint32_t most);
    void draw(gpu::Pipeline& pipeline, const ShadowPrograms& programs, const Drawing& drawing,
              const Casters& casters) const;
    bool addFigureLayer();
    void copyToFigureLayer(int layer, std::span<const glm::ivec2> slots) const;
    [[nodiscard]] gpu::Scissor bindTiles(const ShadowTiles& tiles, std::size_t layer) const;
    std::size_t figureLayer() const { return static_cast<std::size_t>(clipmap_.layers()); }

    Shape shape_;
    ShadowClipmap clipmap_;
    gpu::Texture2DArray depths_;
    std::vector<gpu::Framebuffer> layers_;
    FigureShadows figureShadows_;
    bool hasFigures_ = false;     // the nearest map is read from figureLayer()
    bool canHaveFigures_ = true;  // until there is no memory for their layer
    gpu::Sampler compared_, plain_;
    gpu::Buffer uniforms_, records_;
    std::size_t drawnTriangles_ = 0;
};

}  // namespace terrane::render
