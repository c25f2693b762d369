#include "terrane/world/blocks/block_registry.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cassert>
#include <map>
#include <memory>
#include <optional>
#include <unordered_set>
#include <utility>

#include "terrane/base/text.h"
#include "terrane/world/blocks/block_parser.h"
#include "terrane/world/items/item_table.h"

namespace terrane::world {

namespace {

constexpr std::size_t kBulkyParts = kCellParts / 4;

Box boxOf(const ShapeBox& box) {
    constexpr float kPart = 1.0f / kSixteenths;
    return {kPart * glm::vec3(box.min), kPart * glm::vec3(box.max)};
}

}  // namespace

std::shared_ptr<const BlockModel> ModelTable::modelOf(const ShapePtr& shape) {
    std::shared_ptr<const BlockModel>& known = models_[shape];
    if (known) return known;
    auto model = std::make_shared<BlockModel>();
    model->stateMask = formMask(*shape);
    model->isBulky =
        filledParts(shape->main.collision.empty() ? shape->main.boxes : shape->main.collision) >= kBulkyParts;
    for (unsigned state = 0; state <= model->stateMask; ++state) {
        const unsigned form = state & model->stateMask;  // that of a lower state where other bits are set
        model->forms.push_back(form < state ? model->forms[form]
                                            : formOf(shapeAt(*shape, static_cast<std::uint16_t>(form))));
    }
    entries_ += model->forms.size();
    known = std::move(model);
    return known;
}

ModelForm ModelTable::formOf(const ShapePart& part) {
    ModelForm form;
    for (const ShapeBox& box : part.collision) {
        form.boxes.push_back(boxOf(box));
        const Box& added = form.boxes.back();
        if (form.boxes.size() == 1) form.bounds = added;
        form.bounds = {glm::min(form.bounds.min, added.min), glm::max(form.bounds.max, added.max)};
    }
    std::vector<ShapeQuad> quads;
    for (const ShapeRectangle& rectangle : surfaceOf(part.boxes)) quads.push_back(quadOf(rectangle));
    quads.insert(quads.end(), part.quads.begin(), part.quads.end());
    for (const ShapeQuad& given : quads) {
        const ShapeQuad quad = withDefaults(given);
        form.faces.push_back({.shapeFace = number(shapeFaceOf(quad)),
                              .look = *quad.look,
                              .direction = directionOf(quad),
                              .hiddenBy = *quad.hiddenBy,
                              .isTwoSided = quad.isTwoSided});
    }
    mostFormFaces_ = std::max(mostFormFaces_, form.faces.size());
    entries_ += form.faces.size();
    return form;
}

std::uint16_t ModelTable::number(const shared::ShapeFace& face) {
    if (!fits()) return 0;  // the blocks are refused
    const auto known = std::ranges::find_if(faces_, [&](const shared::ShapeFace& other) {
        return other.base == face.base && other.axisU == face.axisU && other.axisV == face.axisV &&
               other.bend == face.bend;
    });
    const auto index = static_cast<std::size_t>(known - faces_.begin());
    if (known == faces_.end()) faces_.push_back(face);
    return static_cast<std::uint16_t>(shared::kShapeFaceCount + index);
}

namespace {

// Materials and textures are numbered with 16 bits.
constexpr std::size_t kMaxNumbered = 65536;

BlockDescription describeMissing() {
    BlockDescription block;
    block.type.name = "missing";
    block.type.collision = {shapeBox(Shape::Cube)};
    block.type.generated = false;
    block.faces.fill({.texture = "missing"});
    return block;
}

BlockType describeAir() {
    BlockType air;
    air.name = "air";
    air.shape = Shape::None;
    air.opacity = 0;
    air.selectable = false;
    return air;
}

// Numbers materials and textures in order of first use.
class Materials {
  public:
    // Sets the type's materials. False if 16 bits do not suffice.
    bool numberFaces(BlockDescription& block) {
        bool fits = true;
        const auto set = [&](std::uint16_t& material, const FaceDescription& face) {
            const auto number = this->number(face, block);
            fits = fits && number;
            material = number.value_or(0);
        };
        for (std::size_t face = 0; face < kFaceCount; ++face)
            set(block.type.material[face], block.faces[face]);
        block.type.growth.resize(block.growth.size());
        for (std::size_t left = 1; left <= block.growth.size(); ++left) {
            set(block.type.growth[left - 1], block.growth[block.growth.size() - left]);
        }
        return fits;
    }

    std::vector<Material> takeMaterials() { return std::move(materials_); }
    std::vector<std::string> takeTextures() { return std::move(textures_); }

  private:
    // None if 16 bits do not suffice.
    std::optional<std::uint16_t> number(const FaceDescription& face, const BlockDescription& block) {
        const auto texture = static_cast<std::uint32_t>(
            textureNumbers_.try_emplace(face.texture, textureNumbers_.size()).first->second);
        if (texture == textures_.size()) textures_.push_back(face.texture);

        const Material material{.texture = static_cast<std::uint16_t>(texture),
                                .alpha = face.alpha,
                                .animation = block.animation,
                                .twoSided = face.twoSided,
                                .wrap = face.wrap,
                                .filtering = face.filtering,
                                .surface = block.type.surface,
                                .tinted = face.tinted};
        const auto number = numbers_.try_emplace(material, numbers_.size()).first->second;
        if (texture >= kMaxNumbered || number >= kMaxNumbered) return std::nullopt;
        if (number == materials_.size()) materials_.push_back(material);
        return static_cast<std::uint16_t>(number);
    }

    std::map<std::string, std::size_t> textureNumbers_;
    std::map<Material, std::size_t> numbers_;
    std::vector<Material> materials_;
    std::vector<std::string> textures_;
};

// Through the holes of leaves mostly more leaves are visible: from afar the holes are closed. The block then
// hides blocks behind it, so it must not wave.
void lookFromAfar(BlockDescription& block) {
    for (FaceDescription& face : block.faces) {
        if (face.alpha != AlphaMode::Test) continue;
        face.alpha = AlphaMode::Unused;
        face.twoSided = false;
        block.animation = Animation::None;
    }
    block.type.opaqueCube = isOpaqueCube(block);
}

// From afar thin models are left out, and others are cubes.
void simplifyModel(BlockDescription& block) {
    const bool isBulky = block.type.model->isBulky;
    block.type.shape = isBulky ? Shape::Cube : Shape::None;
    block.type.model = nullptr;
}

auto tooManyFaces(const BlockDescription& block) {
    return base::fail("{}:{}: texture: expected at most {} different faces in all blocks, got more",
                      block.file, block.line, kMaxNumbered);
}

// Names must be unique, and blocks that behaviors name must exist.
base::Result<void> checkNames(std::span<const BlockDescription> blocks) {
    std::unordered_set<std::string_view> names{"air", "missing"};
    for (const BlockDescription& block : blocks)
        if (!names.insert(block.type.name).second)
            return base::fail(base::ErrorCode::BadInput,
                              "{}:{}: name: expected a name not used before, got \"{}\"", block.file,
                              block.line, block.type.name);
    for (const BlockDescription& block : blocks)
        for (const BehaviorCall& call : block.calls)
            for (const auto& [parameter, name] : call.arguments.blocks)
                if (!names.contains(name))
                    return base::fail(base::ErrorCode::BadInput,
                                      "{}:{}: behaviors.{}: expected the name of a block, got \"{}\"",
                                      block.file, call.line, parameter, base::printable(name));
    return {};
}

}  // namespace

base::Result<BlockRegistry> BlockRegistry::parse(std::string_view toml, std::string_view name,
                                                 const BehaviorTable& behaviors) {
    auto file = TERRANE_TRY(parseBlocks(toml, name, behaviors));
    return fromDescriptions(std::move(file.blocks), name);
}

base::Result<BlockRegistry> BlockRegistry::fromDescriptions(std::vector<BlockDescription> blocks,
                                                            std::string_view name,
                                                            std::span<const ItemFile> items) {
    if (blocks.size() > kMaxDescribedBlocks)
        return base::fail(base::ErrorCode::BadInput, "{}: expected at most {} blocks, got {}", name,
                          kMaxDescribedBlocks, blocks.size());
    TERRANE_TRY(checkNames(blocks));
    blocks.push_back(describeMissing());

    BlockRegistry registry;
    Materials materials;
    ModelTable models;
    registry.types_.push_back(describeAir());
    for (BlockDescription& block : blocks) {
        BlockType& type = block.type;
        for (const BehaviorCall& call : block.calls)
            type.behaviors.push_back(std::make_shared<const BlockBehavior>(behaviorOf(call)));
        type.id = static_cast<BlockId>(registry.types_.size());
        type.opaqueCube = isOpaqueCube(block);
        if (!materials.numberFaces(block)) return tooManyFaces(block);
        if (block.shape) type.model = models.modelOf(block.shape);
        if (!models.fits())
            return base::fail(
                "{}:{}: shape: expected at most {} different faces in all shapes, {} faces in each form of "
                "one, and {} forms and faces in all",
                block.file, block.line, ModelTable::kMaxFaces, ModelTable::kMaxFormFaces,
                ModelTable::kMaxEntries);
        registry.types_.push_back(type);
    }
    registry.modelFaces_ = models.takeFaces();
    assert(registry.types_.size() <= kMaxNumbered && "the parser limits blocks to what ids can tell apart");
    registry.missing_ = registry.types_.back().id;
    registry.farTypes_ = registry.types_;
    for (std::size_t k = 0; k < blocks.size(); ++k) {
        BlockDescription& block = blocks[k];
        block.type = registry.types_[k + 1];
        if (block.type.shape != Shape::Cube && block.type.shape != Shape::Model) continue;
        if (block.type.shape == Shape::Model) simplifyModel(block);
        lookFromAfar(block);
        if (!materials.numberFaces(block)) return tooManyFaces(block);
        registry.farTypes_[k + 1] = block.type;
    }
    registry.materials_ = materials.takeMaterials();
    registry.textures_ = materials.takeTextures();
    for (const BlockType& type : registry.types_) registry.byName_.emplace(type.name, type.id);
    registry.items_ = std::make_shared<const ItemTable>(registry.types_, registry.missing_, items);
    return registry;
}

BlockRegistry BlockRegistry::forFarTiles() const {
    BlockRegistry far = *this;
    far.types_ = farTypes_;
    return far;
}

const BlockType* BlockRegistry::find(std::string_view name) const {
    const auto found = byName_.find(std::string(name));
    return found == byName_.end() ? nullptr : &types_[found->second];
}

}  // namespace terrane::world
