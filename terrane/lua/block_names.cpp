#include "terrane/lua/block_names.h"

#include <algorithm>

#include "terrane/base/text.h"
#include "terrane/lua/call.h"

namespace terrane::lua {

std::string BlockNames::find(std::string_view name) {
    if (name == "air") return std::string(name);
    const std::string ofPack = pack_.empty() ? std::string() : fmt::format("{}:{}", pack_, name);
    for (std::string candidate : {ofPack, std::string(name)}) {
        if (const auto alias = aliases_.find(candidate); alias != aliases_.end()) candidate = alias->second;
        if (candidate.empty() || blocks_.find(candidate) == nullptr) continue;
        addUsed(candidate);
        return candidate;
    }
    std::vector<std::string> known;
    const std::string prefix = pack_ + ":";
    for (const world::BlockType& type : blocks_.types())
        known.push_back(type.name.starts_with(prefix) ? type.name.substr(prefix.size()) : type.name);
    fail("unknown block \"{}\"{}", name, base::didYouMean(name, known));
}

void BlockNames::addUsed(std::string_view name) {
    if (std::find(used_.begin(), used_.end(), name) == used_.end()) used_.emplace_back(name);
}

}  // namespace terrane::lua
