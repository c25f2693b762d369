// A content pack: block types, textures, generators and names of blocks as files (docs/packs.md). Read from a
// folder or a zip file (pack_files.h), or from the archive that servers send (pack_files.h). All are plain
// values; any thread may use them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::pack {

// Limits of one pack. Larger packs are refused.
constexpr std::size_t kMaxFiles = 4096;
constexpr std::size_t kMaxPackBytes = std::size_t{64} << 20;  // of all files together
constexpr std::size_t kMaxScriptBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxTableBytes = std::size_t{4} << 20;  // of a TOML file
constexpr std::size_t kMaxGenerators = 64;
constexpr std::size_t kMaxRuleScripts = 64;
// Version of the interface of scripts in packs (docs/scripting.md).
constexpr int kRulesVersion = 1;
constexpr std::size_t kMaxFileName = 31;  // bytes, without ending: a generator's PACK:NAME has at most 64
constexpr std::size_t kMaxPackName = 32;  // bytes

// The pack that comes with the program. Its blocks and textures have no prefix.
constexpr std::string_view kBuiltInPack = "terrane";

// The content of pack.toml.
struct PackInfo {
    std::string name;  // a-z, 0-9, _
    std::string version;
    std::string title, description, license;
    std::vector<std::string> authors;
    std::vector<std::string> requiredPacks;  // loaded before it
    int rules = 0;                           // version of the interface of its scripts; 0: it has none
};

// File contents by path: "pack.toml", "textures/glow_rock.png".
using PackFiles = std::map<std::string, std::string, std::less<>>;

struct Pack {
    PackInfo info;
    PackFiles files;
    std::string where;  // the folder or file, for messages
};

bool isPackName(std::string_view text);
bool hasPack(const std::vector<Pack>& packs, std::string_view name);

// Returns whether a file of this path belongs to packs: pack.toml, blocks.toml, items.toml,
// textures/NAME.png, generators/NAME.lua, scripts/NAME.lua, languages/CODE.toml. Others are left out.
bool isPackPath(std::string_view path);
constexpr std::string_view kScripts = "scripts/";

// Returns the files that clients of a server need: no scripts, and a pack.toml that names none. The hash of a
// pack is theirs, so that a change of rules needs no new pack.
PackFiles clientFiles(const PackFiles& files);

// Reads pack.toml. Errors read "WHERE/pack.toml:line: key: what is wrong".
[[nodiscard]] base::Result<Pack> makePack(PackFiles files, std::string where);

// Returns the path of a file for messages: "WHERE/blocks.toml", or "blocks.toml" of the built-in pack.
std::string displayPath(const Pack& pack, std::string_view path);

// Returns the name of a block, texture or generator of the pack outside of it: "isles:glow_rock"; for the
// built-in pack the name itself.
std::string qualifiedName(const Pack& pack, std::string_view name);

[[nodiscard]] base::Result<Pack> builtInPack();

// The template that new packs start from. Any thread may use it. The name of the skeleton's generator, within
// the pack.
constexpr std::string_view kSkeletonGenerator = "hills";

// Writes a pack that works as it is: a glowing block with its texture, a generator that uses it, names of
// blocks, all with comments. The pack has the folder's name. Returns an error if the folder exists.
[[nodiscard]] base::Result<void> writeSkeleton(const std::filesystem::path& folder);

}  // namespace terrane::pack
