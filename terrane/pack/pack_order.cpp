#include "terrane/pack/pack_order.h"

#include <algorithm>
#include <set>
#include <utility>

namespace terrane::pack {
namespace {

base::Result<void> checkRequired(const std::vector<Pack>& packs) {
    std::set<std::string_view> names{kBuiltInPack};
    for (const Pack& pack : packs)
        if (!names.insert(pack.info.name).second)
            return base::fail(base::ErrorCode::BadInput, "{}/pack.toml: name: there is another pack \"{}\"",
                              pack.where, pack.info.name);
    for (const Pack& pack : packs)
        for (const std::string& name : pack.info.requiredPacks)
            if (!names.contains(name))
                return base::fail(base::ErrorCode::BadInput,
                                  "{}/pack.toml: requires: the pack \"{}\" is not loaded", pack.where, name);
    return {};
}

}  // namespace

base::Result<std::vector<Pack>> inOrder(Pack builtIn, std::vector<Pack> packs) {
    TERRANE_TRY(checkRequired(packs));
    std::vector<Pack> ordered;
    std::set<std::string> done{std::string(kBuiltInPack)};
    ordered.push_back(std::move(builtIn));
    while (!packs.empty()) {
        const auto next = std::ranges::find_if(packs, [&](const Pack& pack) {
            return std::ranges::all_of(pack.info.requiredPacks,
                                       [&](const std::string& name) { return done.contains(name); });
        });
        if (next == packs.end())
            return base::fail(base::ErrorCode::BadInput,
                              "{}/pack.toml: requires: packs require each other in a circle",
                              packs.front().where);
        done.insert(next->info.name);
        ordered.push_back(std::move(*next));
        packs.erase(next);
    }
    return ordered;
}

}  // namespace terrane::pack
