#include "apps/terrane/window/game/game_interface.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "apps/terrane/window/game/game_menu.h"
#include "apps/terrane/window/hud/compass.h"
#include "apps/terrane/window/hud/container_dialog.h"
#include "apps/terrane/window/hud/hand_view.h"
#include "apps/terrane/window/hud/inventory_dialog.h"
#include "apps/terrane/window/hud/overlay.h"
#include "apps/terrane/window/hud/places_panel.h"
#include "apps/terrane/window/settings/panel.h"
#include "terrane/base/machine.h"
#include "terrane/view/block_particles.h"
#include "terrane/view/camera_path.h"
#include "terrane/world/tint.h"

namespace terrane::app {

namespace {

MemoryStatistics memoryOf(const GameParts& parts) {
    return {.blocks = parts.session.world().memoryBytes(),
            .light = parts.session.pipeline().lightBytes(),
            .quads = parts.renderer.quadBytes(),
            .lightOnGpu = parts.renderer.lightBytes(),
            .onGpu = parts.renderer.memory().total(),
            .gpuBudget = parts.renderer.memoryBudget(),
            .resident = base::residentBytes()};
}

// Particles of broken blocks, as squares in the color of their block. `light`: on them, 0…1.
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

// Refers to the parts and the texts.
BlockFace blockFaceOf(const GameParts& parts, const Texts& tr) {
    return {[&parts](world::BlockId block) {
                return hasWorldImage(parts.renderer) ? parts.preview.image(block) : 0;
            },
            [&parts, &tr](world::BlockId block) { return tr.block(parts.session.blocks().type(block)); }};
}

// Refers to the game.
ItemLooks itemLooksOf(GameState& game) {
    const auto image = [&game](const std::string& item) -> unsigned {
        const world::ItemType* type = game.parts.session.blocks().items().find(item);
        if (!type) return 0;
        if (type->block == world::kAir) return game.itemImages.image(type->texture);
        return blockFaceOf(game.parts, game.tr).image(type->block);
    };
    const auto name = [&game](const std::string& item) {
        return game.parts.session.blocks().items().find(item) ? game.tr.item(item) : item;
    };
    return {image, name};
}

HotbarLook hotbarLookOf(GameState& game) {
    const game::Hotbar& hotbar = game.interaction.hotbar;
    if (!isInSurvival(game)) {
        const BlockFace face = blockFaceOf(game.parts, game.tr);
        const auto drawSlot = [face, &hotbar](std::size_t slot, ImDrawList& draw, glm::vec2 min, float side) {
            if (hotbar.blocks[slot] != world::kAir)
                drawBlockImage(draw, min, side, face.image(hotbar.blocks[slot]));
        };
        return {hotbar.selected, hotbar.block() == world::kAir ? "" : face.name(hotbar.block()), drawSlot};
    }
    const world::Inventory& slots = game.parts.session.itemsOf(game::kLocalPlayer).slots;
    const ItemLooks looks = itemLooksOf(game);
    const world::ItemStack& hand = slots[hotbar.selected];
    const auto drawSlot = [looks, &slots, &game](std::size_t slot, ImDrawList& draw, glm::vec2 min,
                                                 float side) {
        drawStack(draw, {min.x, min.y}, {min.x + side, min.y + side}, slots[slot], looks,
                  game.parts.session.blocks().items());
    };
    return {hotbar.selected, hand.count == 0 ? "" : looks.name(hand.item), drawSlot};
}

std::string targetText(const game::BlockInteraction& interaction, const game::Session& session,
                       const Texts& tr) {
    const auto& target = interaction.target();
    if (!target) return {};
    const world::World& world = session.world();
    const std::uint16_t state = world.blockState(target->block);
    const std::string name = tr.block(session.blocks().type(world.block(target->block)));
    return fmt::format("{}{}  {}, {}, {}", name, state == 0 ? "" : fmt::format(" ({})", state),
                       target->block.x, target->block.y, target->block.z);
}

PlaceFacts placeFactsOf(Hud& hud, game::Session& session, const world::Pose& pose, std::string target,
                        double framesASecond) {
    const world::BlockPos at = world::blockOf(pose.position);
    const store::WorldIdentity& identity = session.store().identity();
    if (std::exchange(hud.asksForBiomes, false))  // takes a tenth of a second
        hud.biomes = gen::BiomeMap::create(identity.generator, session.blocks(), identity.seed);
    return {.pose = pose,
            .biome = hud.biomes ? std::string(hud.biomes->at(at.x, at.y)) : std::string(),
            .world = fmt::format("{}, seed {}", identity.generator, identity.seed),
            .target = std::move(target),
            .timeDay = session.clock.timeDay,
            .framesASecond = framesASecond};
}

void drawPaletteDialog(GameState& game, const Screen& screen) {
    const auto choice = drawPalette(screen, game.hud.palette, game.parts.session.blocks(),
                                    blockFaceOf(game.parts, game.tr), game.tr);
    if (!choice) return;
    game::selectBlock(game.interaction.hotbar, *choice);
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

Statistics statisticsOf(GameState& game) {
    const GameParts& parts = game.parts;
    const game::Session& session = parts.session;
    return {.frames = &game.meter,
            .camera = cameraOf(game.player, game.settings),
            .timeDay = session.clock.timeDay,
            .renderScale = parts.renderer.options().renderScale,
            .progress = session.pipeline().progress(),
            .tiles = &session.tiles().table(),
            .activeChunks = session.world().chunkCount(),
            .queuedChunks = session.pipeline().queuedCount() + parts.view.waiting(),
            .frame = parts.renderer.statistics(),
            .memory = game.memory.at(game.seconds, [&] { return memoryOf(parts); }),
            .tasks = session.taskTimes(),
            .passes = &parts.renderer.passTimes()};
}

void advanceHud(Hud& hud, const world::Pose& player, const PlaySettings& settings,
                const game::Session& session, double seconds) {
    const glm::dvec3 step = player.position - hud.walkedFrom;
    hud.walkedFrom = player.position;
    hud.hand.advance(seconds, std::hypot(step.x, step.y),
                     settings.movement == game::Movement::Walk && !settings.reducedMotion);
    hud.screenshot.advance(seconds);
    hud.particles.advance(seconds, session.world(), session.blocks());
}

namespace {

// The interface is shown: it is not hidden, and the view is the player's.
bool showsHud(const GameState& game) {
    return !game.hud.isHidden && !game.debug.isAbove && hasWorldImage(game.parts.renderer);
}

// The arm and splinters of broken blocks.
void drawHand(GameState& game, const Screen& screen, const render::Camera& camera) {
    if (!showsHud(game)) return;
    const GameParts& parts = game.parts;
    const glm::vec3 light = lightOnHand(parts.session, game.player.pose().position);
    drawParticles(screen, camera, game.hud.particles, parts.renderer.topColors(), light);
    const world::BlockId block = game.interaction.block();
    const world::ItemStack& hand = parts.session.itemsOf(game::kLocalPlayer).hand();
    unsigned image = block == world::kAir ? 0 : blockFaceOf(parts, game.tr).image(block);
    if (isInSurvival(game) && hand.count > 0) image = itemLooksOf(game).image(hand.item);
    game.hud.hand.draw(screen, image, light);
}

// `seconds`: since the last frame.
void drawHotbar(GameState& game, OverlayLayout& layout, double seconds) {
    if (!showsHud(game)) return;
    game.hud.hotbar.draw(layout, hotbarLookOf(game), seconds);
}

void drawFacts(GameState& game, OverlayLayout& layout) {
    if (!showsHud(game) || !game.hud.showsFacts) return;
    game::Session& session = game.parts.session;
    drawPlaceFacts(layout,
                   placeFactsOf(game.hud, session, game.player.pose(),
                                targetText(game.interaction, session, game.tr), game.meter.now()),
                   game.tr);
}

// The direction to the sun or moon; none without shadows.
std::optional<glm::vec3> shadowLightOf(const GameParts& parts) {
    const render::RenderOptions& options = parts.renderer.options();
    if (options.shadows == render::ShadowReach::Off || options.shading == render::Shading::Off)
        return std::nullopt;
    return world::environmentAt(static_cast<float>(parts.session.clock.timeDay)).lightDirection;
}

// A bar below the crosshair: how much of the block is broken. `share`: 0 to 1.
void drawMining(const Screen& screen, double share) {
    if (share <= 0) return;
    const float scale = uiScale(), half = 20 * scale, top = screen.height / 2 + 14 * scale;
    const float left = screen.width / 2 - half, width = 2 * half * static_cast<float>(share);
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.AddRectFilled({left, top}, {left + 2 * half, top + 4 * scale}, IM_COL32(0, 0, 0, 140));
    draw.AddRectFilled({left, top}, {left + width, top + 4 * scale}, IM_COL32(255, 255, 255, 220));
}

void drawLinesInWorld(const GameState& game, const Screen& screen, const render::Camera& camera) {
    const GameParts& parts = game.parts;
    if (game.debug.isAbove) {
        const int viewDistance = parts.view.viewDistance();
        drawDebugTopView(screen, debugTopCamera(camera, viewDistance), camera,
                         view::fogDistance(viewDistance), shadowLightOf(parts));
    } else if (const auto& target = game.interaction.target(); target && !game.hud.isHidden) {
        drawMining(screen, game.interaction.broken());
        drawTarget(screen, camera, *target,
                   {parts.session.world(), parts.session.blocks(), game.settings.highContrast});
    }
}

void drawRemoteNames(GameState& game, const Screen& screen, const render::Camera& camera) {
    if (game.remote.play && !game.hud.isHidden && !game.debug.isAbove)
        drawNames(screen, camera, game.remote.others.names,
                  {game.parts.session.world(), game.parts.session.blocks()});
}

void drawRemote(GameState& game, OverlayLayout& layout) {
    if (drawChat(layout, game.remote, game.parts.session, game.seconds, game.tr)) captureMouse(game, true);
}

// Frees the cursor while the player types or chooses something.
void drawBuilding(GameState& game, OverlayLayout& layout) {
    if (!game.debug.isAbove) game.building.drawPanels(layout, buildViewOf(game));
    if (auto message = game.building.takeMessage()) game.notices.say(std::move(*message));
    const bool asks = game.building.isAsking();
    if (asks != std::exchange(game.wasAsking, asks)) captureMouse(game, !asks);
}

void drawDebugPanels(GameState& game, OverlayLayout& layout) {
    if (!game.debug.showsPanel) return;
    drawPanel(layout, game.settings, game.parts.session.clock, game.options.isSoftwareRenderer);
    drawStatistics(layout, statisticsOf(game));
}

// The items of a player in survival, with the open chest.
void drawInventoryDialog(GameState& game, const Screen& screen) {
    game::Session& session = game.parts.session;
    const glm::dvec3 eyes = game.player.pose().position;
    InventoryState& state = game.hud.inventory;
    const bool isFar = state.workbench && !canUseWorkbench(session, *state.workbench, eyes);
    if (isFar || (game.container && !canUseContainer(session, *game.container, eyes)))
        return captureMouse(game, true);
    for (const game::ItemAction& action :
         drawInventory(screen, session, game.container, state, itemLooksOf(game), game.tr))
        (void)session.act(game::kLocalPlayer, action);
}

// Closes the dialog if the chest is gone or out of reach.
void drawContainerDialog(GameState& game, const Screen& screen) {
    game::Session& session = game.parts.session;
    const world::BlockPos block = *game.container;
    if (!canUseContainer(session, block, game.player.pose().position)) return captureMouse(game, true);
    const auto drawn =
        drawOpenContainer(screen, session, block, game.interaction.hotbar, itemLooksOf(game), game.tr);
    if (drawn) return;
    game.notices.say(drawn.error().message);
    captureMouse(game, true);
}

void drawMenu(GameState& game, const Screen& screen) {
    GameMenu& menu = game.menu;
    const store::SaveStatus status = game.parts.session.store().status();
    if (menu.asksToQuit) {
        if (const auto choice = drawQuitDialog(screen, status, game.tr)) answerQuitDialog(game, *choice);
        return;
    }
    if (menu.showsSettings) {
        const SettingsDialog::Input view{screen, game.tr, game.options.isSoftwareRenderer,
                                         &game.parts.session.clock};
        if (menu.settings.draw(game.settings, view)) closeOne(game);
    } else if (menu.isPaused) {
        if (const auto choice = drawPauseMenu(screen, game.settings.keys, game.tr))
            answerPauseMenu(game, *choice);
    }
}

// In the order of priority: what comes first has the better place (overlay_layout.h).
void drawOverlays(GameState& game, OverlayLayout& layout, double seconds) {
    game::Session& session = game.parts.session;
    drawHotbar(game, layout, seconds);
    if (!game.menu.asksToQuit) drawSaveNotice(layout, session.store().status(), game.tr);
    if (showsHud(game)) drawCompass(layout, game.player.pose(), game.hud.places);
    drawRemote(game, layout);
    drawNoticeMessage(layout, game.notices);
    drawFacts(game, layout);
    drawBuilding(game, layout);
    const stream::Progress progress = session.pipeline().progress();
    game.wasComplete = game.wasComplete || progress.complete();
    if (!game.wasComplete) drawProgress(layout, progress, game.tr);
    drawDebugPanels(game, layout);
    game.hud.screenshot.draw(layout);
    drawNoticeKeys(layout, game.notices, game.settings.keys, game.tr);
    if (game.debug.showsLoading) drawLoadingMap(layout, session.pipeline(), session.tiles().table());
    if (game.input.isCaptured && !game.debug.isAbove && !game.hud.isHidden) drawCrosshair(layout);
}

// Over the overlays, which keep clear of them.
void drawDialogs(GameState& game, const Screen& screen) {
    if (game.hud.palette.isOpen) drawPaletteDialog(game, screen);
    if (game.hud.placesDialog.isOpen) drawPlacesDialog(game, screen);
    const bool isOpen = game.container || game.hud.inventory.isOpen;
    if (isOpen && isInSurvival(game))
        drawInventoryDialog(game, screen);
    else if (game.container)
        drawContainerDialog(game, screen);
    drawMenu(game, screen);
}

}  // namespace

void drawInterface(GameState& game, double seconds) {
    game.imgui.setTextSize(game.settings.textSize);
    game.imgui.beginFrame(game.input.isCaptured,
                          isInMenu(game.menu) || hasOpenDialog(game.hud, game.remote.chat));
    const Screen screen{game.imgui.size().x, game.imgui.size().y};
    const render::Camera camera = cameraOf(game.player, game.settings);
    constexpr int kImages = 2, kImagesInDialog = 8;  // of blocks, drawn per frame
    game.parts.preview.beginFrame(isInDialog(game) ? kImagesInDialog : kImages);
    drawLinesInWorld(game, screen, camera);
    drawRemoteNames(game, screen, camera);
    if (!game.debug.isAbove) game.building.drawInWorld(screen, camera, buildViewOf(game), game.seconds);
    drawHand(game, screen, camera);
    OverlayLayout layout(screen);
    drawOverlays(game, layout, seconds);
    drawDialogs(game, screen);
    game.imgui.endFrame();
}

}  // namespace terrane::app
