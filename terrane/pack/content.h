// The block types, textures and generators of a session, merged from content packs. The thread that starts a
// session creates it; afterwards any thread reads it.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "terrane/content/language.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/pack/pack.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::pack {

// Sorts the packs into the order of loading: `builtIn` first, then each pack after those that it requires,
// otherwise as given. Any thread may call it. Returns an error if a pack is given twice, requires a missing
// one, or requires itself through others.
[[nodiscard]] base::Result<std::vector<Pack>> loadOrder(Pack builtIn, std::vector<Pack> packs);

struct Content {
    // In the order of loading, the built-in one first. Textures are read from their files.
    std::shared_ptr<const std::vector<Pack>> packs;
    std::shared_ptr<const world::BlockRegistry> blocks;
    world::TextureSource textures;
    gen::GeneratorCatalogue generators;  // the built-in ones, then scripts: "isles:floating"
};

// Loads the built-in pack and `packs`, each after those that it requires, otherwise in the order given. Block
// ids follow that order; saves store names. In a pack a name means its own block, texture or shape first,
// then the built-in one. Generators are recorded once, so that errors of scripts are found here. Errors name
// file, line and key.
[[nodiscard]] base::Result<Content> loadContent(
    std::vector<Pack> packs, const world::BehaviorTable& behaviors = world::builtInBehaviors());

// Adds the packs' names of their blocks in this language, or in English where a pack has none.
[[nodiscard]] base::Result<void> addBlockNames(content::Language& language, const Content& content,
                                               std::string_view code);

}  // namespace terrane::pack
