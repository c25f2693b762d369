#include "terrane/view/land_view.h"

#include <algorithm>
#include <exception>
#include <system_error>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"

namespace terrane::view {

namespace {

// Empty beyond the world's edge.
world::LandTile tileOf(const gen::LevelGenerators& generators, const world::BlockRegistry& blocks,
                       world::ChunkPos pos) {
    world::LandTile empty;
    empty.height.fill(static_cast<std::int16_t>(generators.heights().bottom));
    if (!world::isInWorld(pos)) return empty;
    try {
        world::LandTile tile = world::landTileOf(generators.generate(pos), blocks);
        constexpr std::size_t kMiddle = world::LandTile::kColumns / 2 + world::kChunkSize / 2;
        if (const auto tint = generators.tint(pos)) tile.tint = (*tint)[kMiddle];
        return tile;
    } catch (const std::exception& error) {
        base::logWarning("the land around {},{} is not known: {}", pos.x, pos.y, error.what());
        return empty;
    }
}

}  // namespace

LandView::LandView(const game::Session& session, render::Renderer& renderer) : renderer_(renderer) {
    if (const auto used = renderer.useLand(true); !used) {
        base::logError("distant land casts no shadows: {}", used.error().message);
        return;
    }
    const auto make = [&generators = session.generators(), &blocks = session.blocks()](world::ChunkPos pos) {
        TERRANE_ZONE("land tile");
        return tileOf(generators, blocks, pos);
    };
    try {
        maker_.emplace(2 * kTilesPerFrame, make);
    } catch (const std::system_error& error) {
        base::logWarning("no thread can be started for the light of the land: {}", error.what());
    }
}

void LandView::update(world::ChunkPos camera, double reach, std::size_t limit) {
    if (!maker_) return;
    TERRANE_ZONE("take land");
    renderer_.setLandReach(reach);
    for (const auto& [pos, land] : maker_->takeFinished(limit)) renderer_.setLand(pos, land);
    if (!renderer_.readsLand()) return;
    maker_->request(renderer_.landClipmap().missing(camera, reach, maker_->maxRequested()));
    if (limit == kAllTiles) renderer_.completeLand();
}

namespace {

constexpr std::size_t kMaxRequested = 64;

bool hasTintedBlock(const world::BlockRegistry& blocks) {
    return std::ranges::any_of(blocks.materials(), [](const world::Material& m) { return m.tinted; });
}

world::TintTile neutralTile() {
    world::TintTile tile;
    tile.fill(world::kNeutralTint);
    return tile;
}

// Neutral beyond the world's edge.
world::TintTile tileOf(const gen::LevelGenerators& generators, world::ChunkPos pos) {
    if (!world::isInWorld(pos)) return neutralTile();
    try {
        return generators.tint(pos).value_or(neutralTile());
    } catch (const std::exception& error) {
        base::logWarning("the tint around {},{} is not known: {}", pos.x, pos.y, error.what());
        return neutralTile();
    }
}

}  // namespace

TintView::TintView(const game::Session& session, render::Renderer& renderer)
    : generators_(session.generators()), renderer_(renderer) {
    const bool hasTint = hasTintedBlock(session.blocks()) && generators_.hasTint();
    if (const auto used = renderer.useTint(hasTint); !used) {
        base::logError("blocks have no tint: {}", used.error().message);
        return;
    }
    if (!hasTint) return;
    try {
        maker_.emplace(kMaxRequested, [this](world::ChunkPos pos) {
            TERRANE_ZONE("tint");
            return tileOf(generators_, pos);
        });
    } catch (const std::system_error& error) {  // colors are neutral then
        base::logWarning("no thread can be started for the tint of blocks: {}", error.what());
    }
}

void TintView::update(world::ChunkPos camera, double reach, std::size_t limit) {
    if (!maker_) return;
    TERRANE_ZONE("upload tint");
    for (const auto& [pos, colors] : maker_->takeFinished(limit)) renderer_.setTint(pos, colors);
    maker_->request(renderer_.tintClipmap().missing(camera, reach, maker_->maxRequested()));
}

}  // namespace terrane::view
