#include "apps/terrane/window/game_hud.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "apps/terrane/window/compass.h"
#include "apps/terrane/window/game_menu.h"
#include "apps/terrane/window/hand_light.h"
#include "apps/terrane/window/particle_view.h"
#include "apps/terrane/window/place_overlay.h"

namespace terrane::app {
namespace {

BlockFace blockFaceOf(GameState& game) {
    return {
        [&game](world::BlockId block) { return hasWorldImage(game) ? game.parts.preview.image(block) : 0; },
        [&game](world::BlockId block) { return game.tr.block(game.parts.session.blocks().type(block)); }};
}

std::string targetText(const GameState& game) {
    const auto& target = game.interaction.target();
    if (!target) return {};
    const world::World& world = game.parts.session.world();
    const std::uint16_t state = world.blockState(target->block);
    const std::string name = game.tr.block(game.parts.session.blocks().type(world.block(target->block)));
    return fmt::format("{}{}  {}, {}, {}", name, state == 0 ? "" : fmt::format(" ({})", state),
                       target->block.x, target->block.y, target->block.z);
}

PlaceFacts placeFactsOf(GameState& game) {
    Hud& hud = game.hud;
    game::Session& session = game.parts.session;
    const world::BlockPos at = world::blockOf(game.player.pose().position);
    const store::WorldIdentity& identity = session.store().identity();
    if (std::exchange(hud.asksForBiomes, false))  // takes a tenth of a second
        hud.biomes = gen::BiomeMap::create(identity.generator, session.blocks(), identity.seed);
    return {.pose = game.player.pose(),
            .biome = hud.biomes ? std::string(hud.biomes->at(at.x, at.y)) : std::string(),
            .world = fmt::format("{}, seed {}", identity.generator, identity.seed),
            .target = targetText(game),
            .timeDay = session.clock.timeDay,
            .framesASecond = game.meter.now()};
}

void drawPaletteDialog(GameState& game, const Screen& screen) {
    const auto choice =
        drawPalette(screen, game.hud.palette, game.parts.session.blocks(), blockFaceOf(game), game.tr);
    if (!choice) return;
    game::takeInHand(game.interaction.hotbar, *choice);
    captureMouse(game, true);
}

void drawPlacesDialog(GameState& game, const Screen& screen) {
    Hud& hud = game.hud;
    const PlacesAnswer answer = drawPlaces(screen, hud.placesDialog, hud.places, game.player.pose(), game.tr);
    if (answer.isChanged) game::savePlaces(game.parts.session.store(), hud.places);
    if (!answer.goTo) return;
    game.player.placeAt(*answer.goTo, game.settings.movement);
    captureMouse(game, true);
}

}  // namespace

void advanceHud(GameState& game, double seconds) {
    Hud& hud = game.hud;
    const glm::dvec3 step = game.player.pose().position - hud.walkedFrom;
    hud.walkedFrom = game.player.pose().position;
    hud.hand.advance(seconds, std::hypot(step.x, step.y),
                     game.settings.movement == game::Movement::Gravity && !game.settings.reducedMotion);
    hud.screenshot.advance(seconds);
    hud.particles.advance(seconds, game.parts.session.world(), game.parts.session.blocks());
}

void drawHud(GameState& game, const Screen& screen, const render::Camera& camera, double seconds) {
    constexpr int kImages = 2, kImagesInDialog = 8;
    Hud& hud = game.hud;
    game.parts.preview.beginFrame(isInDialog(game) ? kImagesInDialog : kImages);
    if (!hud.isHidden && !game.debug.isAbove && hasWorldImage(game)) {
        const glm::vec3 light = lightOnHand(game.parts.session, game.player.pose().position);
        drawParticles(screen, camera, hud.particles, game.parts.renderer.topColors(), light);
        drawCompass(screen, game.player.pose(), hud.places);
        if (hud.showsFacts) drawPlaceFacts(placeFactsOf(game), game.tr);
        const world::BlockId block = game.interaction.block();
        hud.hand.draw(screen, block == world::kAir ? 0 : blockFaceOf(game).image(block), light);
        hud.hotbar.draw(screen, game.interaction.hotbar, blockFaceOf(game), seconds);
    }
    hud.screenshot.draw(screen);
    if (hud.palette.isOpen) drawPaletteDialog(game, screen);
    if (hud.placesDialog.isOpen) drawPlacesDialog(game, screen);
}

}  // namespace terrane::app
