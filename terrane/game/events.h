// Events of a session: what happens in a world, for any number of listeners in C++ and Lua. Listeners are
// called in the order in which they were added, on the world's thread. An event whose name begins with Before
// comes before its cause and may be refused, with a reason that the player reads; then the listeners after it
// are not called. Listeners of such events change nothing. The other events tell what happened, and their
// listeners may change the world.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "terrane/game/build_command.h"
#include "terrane/game/edit_command.h"
#include "terrane/game/edit_history.h"
#include "terrane/game/permissions.h"

namespace terrane::game {

// Keeps a listener. The listener is removed when this is destroyed, which may be after its session.
class [[nodiscard]] Subscription {
  public:
    Subscription() = default;
    explicit Subscription(std::function<void()> remove) : remove_(std::move(remove)) {}
    Subscription(Subscription&& other) noexcept : remove_(std::exchange(other.remove_, nullptr)) {}
    Subscription& operator=(Subscription&& other) noexcept {
        std::swap(remove_, other.remove_);
        return *this;
    }
    ~Subscription() {
        if (remove_) remove_();
    }

  private:
    std::function<void()> remove_;
};

// The listeners of one kind of event.
template <class Event>
class Listeners {
  public:
    using Listener = std::function<void(Event&)>;

    // Listeners that are added while an event is told hear the next one.
    Subscription add(Listener listener) {
        auto added = std::make_shared<Listener>(std::move(listener));
        list_->push_back(added);
        return Subscription([list = std::weak_ptr(list_), added] {
            *added = nullptr;  // the list may be in use
            if (const auto kept = list.lock()) std::erase(*kept, added);
        });
    }

    bool isEmpty() const { return list_->empty(); }

    // Tells the event to all, or until one refuses it.
    void notify(Event& event) const {
        const List told = *list_;
        for (const auto& listener : told) {
            if (*listener) (*listener)(event);
            if constexpr (requires { event.refusal; })
                if (event.refusal) return;
        }
    }
    void notify(Event&& event) const { notify(event); }

  private:
    using List = std::vector<std::shared_ptr<Listener>>;
    std::shared_ptr<List> list_ = std::make_shared<List>();
};

struct Refusable {
    std::optional<std::string> refusal = {};  // the reason, for the player
};

struct PlayerJoined {
    PlayerId player = kNoPlayer;
    std::string name;
};
struct PlayerLeft {
    PlayerId player = kNoPlayer;
};

struct ChatLine {
    PlayerId player = kNoPlayer;
    std::string text;
};
struct BeforeChat : ChatLine, Refusable {};

// A command of the chat: "/name arguments".
struct CommandLine {
    PlayerId player = kNoPlayer;
    std::string name, arguments;
};
struct BeforeCommand : CommandLine, Refusable {};

// What a player does to one block. Consequences, such as a plant that falls, are no events of their own.
enum class BlockAct : std::uint8_t { Break, Place, Use };
struct BlockAction {
    BlockAct act = BlockAct::Break;
    PlayerId player = kNoPlayer;
    world::BlockPos pos;
    world::BlockId before = world::kAir, after = world::kAir;  // equal if it is used
};
struct BeforeBlockAction : BlockAction, Refusable {};

// What a player does to many blocks at once.
enum class BuildAct : std::uint8_t { Fill, Structure, Undo, Redo };
struct BuildAction {
    BuildAct act = BuildAct::Fill;
    PlayerId player = kNoPlayer;
    world::BlockBox box;
    std::size_t blocks = 0;  // that change
};
struct BeforeBuildAction : BuildAction, Refusable {};

// Each change of blocks, by anybody, with its consequences: for sounds and screens. Its listeners change no
// block.
struct BlocksEdited {
    PlayerId player = kNoPlayer;
    std::span<const world::BlockEdit> edits;
};
// The blocks that an edit, building, undoing, growth or flow changed, each once: for a history of who changed
// what. Flow is a change by the author whose edit made the liquid flow; growth, and flow that nobody is known
// to have caused, are changes by nobody. Its listeners change no block.
struct BlocksChanged {
    Author author;
    std::span<const ChangedBlock> blocks;
};

// The items or the mode of a player changed. Told after the changes of blocks that belong to it.
struct ItemsChanged {
    PlayerId player = kNoPlayer;
};
// A player used an item that is no block. Food is one less by now.
struct ItemUsed {
    PlayerId player = kNoPlayer;
    std::string item;
};
struct ItemsCrafted {
    PlayerId player = kNoPlayer;
    world::ItemStack made;
};

struct ClaimChanged {
    Claim claim;
    bool isAdded = false;  // else removed
};

// Game time has advanced by world::kTickLength.
struct Ticked {
    std::uint64_t tick = 0;
};
// A block of Events::randomTickBlocks that chance picked, about every 68 s (world/changes/random_ticks.h).
struct RandomTicked {
    world::BlockPos pos;
    world::BlockId block = world::kAir;
};

// A line that the world says: in the chat of one player, or of all.
struct Said {
    PlayerId to = kNoPlayer;  // kNoPlayer: all
    std::string text;
};

// Changed chunks go to the store now. What listeners pass to the store is written in the same transaction.
struct Saving {};

struct Events {
    Listeners<PlayerJoined> joined;
    Listeners<PlayerLeft> left;
    Listeners<BeforeChat> beforeChat;
    Listeners<ChatLine> chat;
    Listeners<BeforeCommand> beforeCommand;
    Listeners<CommandLine> command;
    Listeners<BeforeBlockAction> beforeBlock;
    Listeners<BlockAction> block;
    Listeners<BeforeBuildAction> beforeBuild;
    Listeners<BuildAction> build;
    Listeners<BlocksEdited> edited;
    Listeners<BlocksChanged> changed;
    // As `changed`, also with changes that nobody can undo: liquid that becomes unsettled.
    Listeners<BlocksChanged> changedAtAll;
    Listeners<ItemsChanged> items;
    Listeners<ItemUsed> itemUsed;
    Listeners<ItemsCrafted> crafted;
    Listeners<ClaimChanged> claim;
    Listeners<Ticked> tick;
    Listeners<RandomTicked> randomTick;
    Listeners<Said> said;
    Listeners<Saving> saving;

    std::set<world::BlockId> randomTickBlocks;  // told by randomTick
};

}  // namespace terrane::game
