// terrane blocks: lists all block types.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/options.h"
#include "terrane/content/language.h"
#include "terrane/io/open_session.h"

namespace terrane::app {
namespace {

const char* shapeName(world::Shape shape) {
    switch (shape) {
        case world::Shape::None:
            return "none";
        case world::Shape::Cube:
            return "cube";
        case world::Shape::Liquid:
            return "liquid";
        case world::Shape::Cross:
            return "cross";
        case world::Shape::Hash:
            return "hash";
        case world::Shape::Model:
            return "model";
        case world::Shape::Inset:
            return "inset";
    }
    return "";
}

nlohmann::json boxJson(const world::Box& box) {
    return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

nlohmann::json typeJson(const world::BlockRegistry& blocks, const content::Language& english,
                        const world::BlockType& type) {
    nlohmann::json faces = nlohmann::json::array(), collision = nlohmann::json::array();
    if (type.shape != world::Shape::None) {
        for (const std::uint16_t material : type.material) {
            faces.push_back(blocks.textures()[blocks.materials()[material].texture]);
        }
    }
    for (const world::Box& box : type.collision) collision.push_back(boxJson(box));
    return {{"id", type.id},
            {"name", type.name},
            {"shown_name", content::blockName(english, type)},
            {"shape", shapeName(type.shape)},
            {"textures", faces},
            {"opacity", type.opacity},
            {"emission", type.emission},
            {"collision", collision},
            {"selection", type.selectable ? boxJson(type.selection) : nlohmann::json()},
            {"generated", type.generated}};
}

base::Result<void> listBlocks(const io::WorldOptions& options, bool asJson) {
    const auto content = io::loadContent(options);
    if (!content) return tl::unexpected(content.error());
    const auto& blocks = content->blocks;
    auto english = TERRANE_TRY(content::loadLanguage("en"));
    TERRANE_TRY(pack::addBlockNames(english, *content, "en"));
    if (asJson) {
        nlohmann::json list = nlohmann::json::array();
        for (const world::BlockType& type : blocks->types()) list.push_back(typeJson(*blocks, english, type));
        std::cout << list.dump() << '\n';
        return {};
    }
    constexpr fmt::string_view kRow = "{:>4}  {:<21} {:<24}{:<8}{:>8}  {:<12}{}\n";
    fmt::print(kRow, "id", "name", "shown name", "shape", "opacity", "emission", "collides");
    for (const world::BlockType& type : blocks->types()) {
        const auto& e = type.emission;
        fmt::print(kRow, type.id, type.name, content::blockName(english, type), shapeName(type.shape),
                   type.opacity, fmt::format("{},{},{}", e[0], e[1], e[2]),
                   type.collision.empty() ? "no" : "yes");
    }
    return {};
}

}  // namespace

CommandEntry addBlocks(CLI::App& app) {
    auto options = std::make_shared<io::WorldOptions>();
    auto asJson = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("blocks", "List every block type");
    command->add_flag("--json", *asJson, "Print all properties as JSON");
    addContentOption(*command, *options);
    return {command, [options, asJson] { return listBlocks(*options, *asJson); }};
}

}  // namespace terrane::app
