// What the window's loop draws over the image while one plays, and its dialogs of blocks and places.
#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "apps/terrane/window/compass.h"
#include "apps/terrane/window/game.h"
#include "apps/terrane/window/place_overlay.h"
#include "apps/terrane/window/screen_projection.h"
#include "terrane/game/spawn.h"

namespace terrane::app {
namespace {

glm::vec3 displayed(const glm::vec3& linear) {
    return glm::pow(glm::clamp(linear, 0.0f, 1.0f), glm::vec3(1 / 2.2f));
}

world::BlockPos blockAt(const glm::dvec3& point) {
    const glm::dvec3 at = glm::floor(point);
    return {static_cast<std::int32_t>(at.x), static_cast<std::int32_t>(at.y),
            static_cast<std::int32_t>(at.z)};
}

}  // namespace

void drawParticles(const Screen& screen, const render::Camera& camera, const view::BlockParticles& particles,
                   const world::TopColors& colors, const glm::vec3& light) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float perBlock = screen.height / (2 * std::tan(glm::radians(camera.fieldOfView) / 2));
    const ScreenProjection projection({screen.width, screen.height}, camera);
    for (const view::Particle& p : particles.particles()) {
        const auto at = projection.at(p.position);
        const double distance = glm::distance(p.position, camera.position);
        if (!at || distance < 0.3 || p.block >= colors.size()) continue;
        const float half = p.side / 2 * perBlock / static_cast<float>(distance);
        const float shade = 0.7f + 0.3f * static_cast<float>(p.shade) / 255;
        const glm::vec3 color = glm::clamp(colors[p.block].mean * light * shade, 0.0f, 255.0f);
        draw.AddRectFilled(
            {at->x - half, at->y - half}, {at->x + half, at->y + half},
            IM_COL32(static_cast<int>(color.x), static_cast<int>(color.y), static_cast<int>(color.z), 255));
    }
}

// As shading does it, without the details: daylight of the sky and of lamps in the block of the eye.
glm::vec3 Game::lightOnHand() const {
    const auto there = parts_.session.pipeline().lightAt(blockAt(player_.pose().position));
    const light::LightValue value = there.value_or(light::kFullDaylight);
    const world::Environment sky = world::environmentAt(static_cast<float>(parts_.session.clock.timeDay));
    const auto level = [&](int component) {
        return static_cast<float>(light::levelOf(value, component)) / light::kMaxLevel;
    };
    const glm::vec3 lamps(level(light::kRed), level(light::kGreen), level(light::kBlue));
    const float day = level(light::kDaylight);
    return glm::max(displayed(day * day * (sky.ambientColor + 0.6f * sky.lightColor) + lamps * lamps),
                    glm::vec3(0.12f));
}

BlockFace Game::blockFace() {
    return {[this](world::BlockId block) { return hasWorldImage() ? parts_.preview.image(block) : 0; },
            [this](world::BlockId block) { return tr_.block(parts_.session.blocks().type(block)); }};
}

std::string Game::targetText() const {
    const auto& target = interaction_.target();
    if (!target) return {};
    const world::World& world = parts_.session.world();
    const std::uint16_t state = world.blockState(target->block);
    const std::string name = tr_.block(parts_.session.blocks().type(world.block(target->block)));
    return fmt::format("{}{}  {}, {}, {}", name, state == 0 ? "" : fmt::format(" ({})", state),
                       target->block.x, target->block.y, target->block.z);
}

PlaceFacts Game::placeFacts() {
    const world::BlockPos at = blockAt(player_.pose().position);
    const store::WorldIdentity& identity = parts_.session.store().identity();
    if (std::exchange(hud_.asksForBiomes, false))  // takes a tenth of a second
        hud_.biomes = gen::BiomeMap::create(identity.generator, parts_.session.blocks(), identity.seed);
    return {.pose = player_.pose(),
            .biome = hud_.biomes ? std::string(hud_.biomes->at(at.x, at.y)) : std::string(),
            .world = fmt::format("{}, seed {}", identity.generator, identity.seed),
            .target = targetText(),
            .timeDay = parts_.session.clock.timeDay,
            .framesASecond = meter_.now()};
}

void Game::drawHud(const Screen& screen, const render::Camera& camera, double seconds) {
    constexpr int kImages = 2, kImagesInDialog = 8;
    parts_.preview.beginFrame(isInDialog() ? kImagesInDialog : kImages);
    if (!hud_.isHidden && !isAbove_ && hasWorldImage()) {
        const glm::vec3 light = lightOnHand();
        drawParticles(screen, camera, hud_.particles, parts_.renderer.topColors(), light);
        drawCompass(screen, player_.pose(), hud_.places);
        if (hud_.showsFacts) drawPlaceFacts(placeFacts(), tr_);
        const world::BlockId block = interaction_.block();
        hud_.hand.draw(screen, block == world::kAir ? 0 : blockFace().image(block), light);
        hud_.hotbar.draw(screen, interaction_.hotbar, blockFace(), seconds);
    }
    hud_.screenshot.draw(screen);
    if (hud_.palette.isOpen) drawPaletteDialog(screen);
    if (hud_.placesDialog.isOpen) drawPlacesDialog(screen);
}

void Game::drawPaletteDialog(const Screen& screen) {
    const auto choice = drawPalette(screen, hud_.palette, parts_.session.blocks(), blockFace(), tr_);
    if (!choice) return;
    game::takeInHand(interaction_.hotbar, *choice);
    capture(true);
}

void Game::drawPlacesDialog(const Screen& screen) {
    const PlacesAnswer answer = drawPlaces(screen, hud_.placesDialog, hud_.places, player_.pose(), tr_);
    if (answer.isChanged) game::savePlaces(parts_.session.store(), hud_.places);
    if (!answer.goTo) return;
    player_.placeAt(*answer.goTo, settings_.movement);
    capture(true);
}

void Game::advanceHud(double seconds) {
    const glm::dvec3 step = player_.pose().position - hud_.walkedFrom;
    hud_.walkedFrom = player_.pose().position;
    hud_.hand.advance(seconds, std::hypot(step.x, step.y),
                      settings_.movement == game::Movement::Gravity && !settings_.reducedMotion);
    hud_.screenshot.advance(seconds);
    hud_.particles.advance(seconds, parts_.session.world(), parts_.session.blocks());
}

// Breaks and builds, and shows that it happened.
void Game::breakAndBuild(double seconds) {
    const auto& target = interaction_.target();
    const std::optional<world::BlockPos> pos = target ? std::optional(target->block) : std::nullopt;
    const world::BlockId before = pos ? parts_.session.world().block(*pos) : world::kAir;
    const auto result = interaction_.act(parts_.session, game::kLocalPlayer, player_, seconds);
    if (!result) return;
    hud_.hand.swing();
    tellRefusal(*result);
    if (pos && before != world::kAir && parts_.session.world().block(*pos) == world::kAir)
        hud_.particles.burst(*pos, before);
}

void Game::tellRefusal(game::EditResult result) {
    if (result == game::EditResult::NotEmpty) say(tr_("it is not empty: take out what is in it first"));
    if (result == game::EditResult::Protected) say(tr_("the lowest layer of the world cannot be broken"));
    if (result == game::EditResult::Claimed) say(tr_("this place belongs to somebody else"));
    if (result == game::EditResult::NotAllowed) say(tr_("guests change nothing"));
}

void Game::takeBack(game::HistoryWay way) {
    const bool isUndo = way == game::HistoryWay::Undo;
    tellTakenBack(parts_.session.takeBack(game::kLocalPlayer, way), isUndo);
}

void Game::tellTakenBack(const game::TakenBack& done, bool isUndo) {
    using Outcome = game::TakenBack::Outcome;
    if (done.outcome == Outcome::Sent) return;
    if (done.outcome == Outcome::NoStep) return say(isUndo ? tr_("nothing to undo") : tr_("nothing to redo"));
    if (done.outcome == Outcome::NotLoaded)
        return say(tr_("too far away: the place of that edit is not loaded"));
    if (done.outcome == Outcome::NotAllowed) return say(tr_("a part of that is not yours to change"));
    const char* what = isUndo ? tr_("undone: {} blocks") : tr_("done again: {} blocks");
    std::string message = fmt::format(fmt::runtime(what), done.blocks);
    if (done.kept > 0) message += fmt::format(fmt::runtime(tr_(", {} changed since and stay")), done.kept);
    say(std::move(message));
}

void Game::goToSpawn() {
    if (!hud_.spawn) hud_.spawn = game::findSpawn(parts_.session.generator(), parts_.session.blocks());
    player_.placeAt(*hud_.spawn, settings_.movement);
    say(tr_("back where the world begins"));
}

}  // namespace terrane::app
