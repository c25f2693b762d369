// Sessions on flat ground with the rules of packs that tests write.
#pragma once

#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "terrane/rules/rules.h"
#include "tests/game/session_fixture.h"

namespace terrane::rules {

inline pack::Pack packOf(const std::string& name, const std::string& script) {
    pack::Pack pack{{}, {{"scripts/main.lua", script}}, name};
    pack.info.name = name;
    pack.info.rules = pack::kRulesVersion;
    return pack;
}

class RulesTest : public game::SessionTest {
  protected:
    RulesTest() {
        session_.setPlayer(game::kLocalPlayer, {.position = {5.5, 5.5, game::kGroundHeight + 2.0}});
        said_ = session_.events.said.add([this](const game::Said& line) { lines_.push_back(line.text); });
    }

    // Runs a script of the pack "test", and lets Ann join.
    void run(const std::string& script) { run({packOf("test", script)}); }
    void run(const std::vector<pack::Pack>& packs) {
        rules_.reset();
        rules_ = std::make_unique<Rules>(session_, packs);
        session_.events.joined.notify({game::kLocalPlayer, "Ann"});
    }
    // What the expressions of a list are, as lines of chat.
    std::vector<std::string> valuesOf(const std::string& list, const std::string& before = "") {
        lines_.clear();
        run(before + "\nevents.on('tick', function() for _, v in ipairs({" + list +
            "}) do chat.say(tostring(v)) end cancel(0) end)");
        tick();
        return lines_;
    }
    void tick(int count = 1) {
        for (int k = 0; k < count; ++k) session_.advance(0.05, world::ChunkPos{0, 0});
    }
    game::EditResult set(world::BlockPos pos, std::string_view name) {
        return session_.edit({game::kLocalPlayer, pos, world::SetBlock{contentBlock(name)}, std::nullopt});
    }
    std::string at(world::BlockPos pos) { return session_.blocks().type(session_.world().block(pos)).name; }
    const std::vector<std::string>& problems() const { return rules_->problems(); }

    const world::BlockPos ground_{5, 5, game::kGroundHeight - 1}, above_{5, 5, game::kGroundHeight};
    std::vector<std::string> lines_;  // said to Ann or to all
    game::Subscription said_;
    std::unique_ptr<Rules> rules_;
};

}  // namespace terrane::rules
