// Logins that must be refused, the answers, and that other players do not notice.
#include "tests/net/hostile_fixture.h"

namespace terrane::net {
namespace {

class HostileLogin : public HostileTest {
  protected:
    // The answer to Login, or to Proof if it is requested.
    Refusal refusalOfLogin(TestWire& wire, const Login& login) {
        wire.say(login);
        const auto messages = wire.take();
        if (const auto refused = refusedIn(messages)) return refused->why;
        wire.say(Proof{server_->state().offer.digests});
        return refusalOf(wire);
    }
    Refusal refusalOfName(const std::string& name) {
        TestWire wire(*server_);
        return refusalOfLogin(wire, greetedLogin(wire, testIdentity(name)));
    }
    void waitForPassword(TestWire& wire) {
        for (int k = 0; k < kMostTicks && clientOf(wire).stage == ServerClient::Stage::Password; ++k) {
            // The clock stands still, since logins have a short time limit.
            net::tick(server_->state(), server_->now);
            server_->finishWork();
        }
    }
};

TEST_F(HostileLogin, ASignatureIsGoodForOneConnection) {
    start();
    const ClientIdentity mallory = testIdentity("Mallory");
    TestWire first(*server_), second(*server_), third(*server_), fourth(*server_);
    const Login good = greetedLogin(first, mallory);
    Greeting greeting = greetingOf(second, mallory);
    greeting.nonce[5] ^= std::byte{1};
    EXPECT_EQ(refusalOfLogin(second, loginOf(mallory, greeting, second.channel)), Refusal::WrongKey)
        << "another nonce";
    greeting = greetingOf(third, mallory);
    EXPECT_EQ(refusalOfLogin(third, loginOf(mallory, greeting, second.channel)), Refusal::WrongKey)
        << "another channel";
    Login otherName = greetedLogin(fourth, mallory);
    otherName.name = "Eve";
    EXPECT_EQ(refusalOfLogin(fourth, otherName), Refusal::WrongKey);
    EXPECT_EQ(refusalOfLogin(first, good), Refusal::Count) << "it is good where it belongs";
}

TEST_F(HostileLogin, ASignatureOfAnotherKeyIsRefused) {
    start();
    TestWire wire(*server_), zero(*server_);
    Login login = greetedLogin(wire, testIdentity("Mallory"));
    login.key = annsIdentity_.key.publicKey;
    EXPECT_EQ(refusalOfLogin(wire, login), Refusal::WrongKey) << "Ann's key without her seed";
    login = greetedLogin(zero, testIdentity("Mallory"));
    login.key = {};
    login.signature = {};
    EXPECT_EQ(refusalOfLogin(zero, login), Refusal::WrongKey) << "a key for which anything is signed";
    EXPECT_TRUE(plays(*ann_));
}

TEST_F(HostileLogin, ANameBelongsToItsKey) {
    start();
    EXPECT_EQ(refusalOfName("Ann"), Refusal::Name);
    EXPECT_EQ(refusalOfName("aNN"), Refusal::Name) << "the case is no difference";
    // Two new players choose the same name: the first gets it.
    TestWire bob(*server_), other(*server_);
    bob.say(greetedLogin(bob, testIdentity("Bob")));
    other.say(greetedLogin(other, testIdentity("BOB")));
    bob.say(Proof{server_->state().offer.digests});
    other.say(Proof{server_->state().offer.digests});
    EXPECT_TRUE(plays(bob));
    EXPECT_EQ(refusalOf(other), Refusal::Name);
}

TEST_F(HostileLogin, BadNames) {
    start();
    for (const char* name : {"", " ", " Bob", "Bob ", "a\" b", "*"})
        EXPECT_EQ(refusalOfName(name), Refusal::Name) << name;
    // These names do not form a valid message.
    for (const char* name : {"a\nb", "a\x1b[2J", "\xff\xfe", "\xe2\x80\xae", "1234567890123456789012345"})
        EXPECT_EQ(refusalOfName(name), Refusal::ProtocolError) << name;
    EXPECT_EQ(refusalOfName("123456789012345678901234"), Refusal::Count) << "24 bytes are a name";
}

TEST_F(HostileLogin, NamesThatLookAlikeOrAreInvisible) {
    start();
    for (const char* name : {"Ann\u200b", "\u3164", "Ann\u00ad", "\u2800", "\u00a0", "\ufeffAnn", "\u0391nn",
                             "\U000e0041nn", "A\uff4en", "Server", "ANN", "a  b"})
        EXPECT_EQ(refusalOfName(name), Refusal::Name) << name;
    for (const char* name : {"\u041c\u0438\u0440", "\u4e16\u754c", "Bob 2", "\U0001f438"})
        EXPECT_EQ(refusalOfName(name), Refusal::Count) << name;
    const auto ian = joined("Ian");
    EXPECT_EQ(refusalOfName("lan"), Refusal::Name) << "like a capital I";
    TestWire wire(*server_);
    wire.say(greetedLogin(wire, testIdentity("I\u0430n")));  // Cyrillic
    const auto refused = refusedIn(wire.take());
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->reason,
              "a name has letters of scripts that are easily confused, such as Latin and Cyrillic");
    TestWire like(*server_);
    like.say(greetedLogin(like, testIdentity("1an")));
    EXPECT_EQ(refusedIn(like.take())->reason,
              "the name 1an looks like Ian, the name of another player: choose another");
}

TEST_F(HostileLogin, ANameIsKeptInItsNormalForm) {
    start();
    const ClientIdentity anna = testIdentity("A\u0301nna");
    for (int k = 0; k < 2; ++k) {  // the same player comes again
        const auto wire = joined(anna);
        EXPECT_EQ(clientOf(*wire).name, "\u00c1nna");
        wire->close();
    }
    EXPECT_EQ(refusalOfName("\u00c1nna"), Refusal::Name);
    EXPECT_EQ(runConsoleLine(server_->state(), "op A\u0301nna"), "\u00c1nna is an operator now");
}

// The player was known before the rule.
TEST_F(HostileLogin, AKnownPlayerKeepsItsName) {
    start();
    const ClientIdentity old = testIdentity("Ann\u200b");
    server_->state().clients.known.add(old.key.publicKey, old.name, game::Role::Player);
    joined(old)->close();
    ClientIdentity renamed = old;
    renamed.name = "\u3164";
    TestWire wire(*server_);
    EXPECT_EQ(refusalOfLogin(wire, greetedLogin(wire, renamed)), Refusal::Name);
    renamed.name = "Bob";
    joined(renamed)->close();
    EXPECT_EQ(server_->state().clients.known.byName(old.name), nullptr) << "the old name is free";
}

TEST_F(HostileLogin, AFullQueueOfPasswordsHasRoomForOtherAddresses) {
    start();
    (void)runConsoleLine(server_->state(), "password secret");
    std::vector<std::unique_ptr<TestWire>> wires;
    const auto comeFrom = [&](const std::string& address) {
        wires.push_back(std::make_unique<TestWire>(*server_));
        TestWire& wire = *wires.back();
        clientOf(wire).address.network = address;
        wire.say(greetedLogin(wire, testIdentity(fmt::format("Player {}", wires.size()))));
        return clientOf(wire).stage == ServerClient::Stage::Password;
    };
    for (int address = 0; address < 8; ++address) {
        for (int k = 0; k < 4; ++k) EXPECT_TRUE(comeFrom(fmt::format("crowd {}", address)));
        EXPECT_FALSE(comeFrom(fmt::format("crowd {}", address))) << "an address has a share";
    }
    EXPECT_TRUE(comeFrom("somewhere else"));
    EXPECT_LE(server_->state().password.queue.size(), 32u);
    std::size_t waiting = 0;
    for (const auto& wire : wires) waiting += clientOf(*wire).stage == ServerClient::Stage::Password;
    EXPECT_EQ(waiting, server_->state().password.queue.size());
}

TEST_F(HostileLogin, OtherVersionsAndOtherWorlds) {
    start();
    TestWire version(*server_), magic(*server_), world(*server_);
    version.say(Hello{kMagic, 99, "test"});
    EXPECT_EQ(refusalOf(version), Refusal::Version);
    magic.say(Hello{kMagic + 1, kProtocolVersion, "test"});
    EXPECT_EQ(refusalOf(magic), Refusal::ProtocolError);
    world.say(greetedLogin(world, testIdentity("Bob")));
    auto digests = server_->state().offer.digests;
    ++digests.back();
    world.say(Proof{digests});
    EXPECT_EQ(refusalOf(world), Refusal::OtherWorld);
}

TEST_F(HostileLogin, WhoIsBannedStaysOut) {
    start();
    const ClientIdentity bob = testIdentity("Bob");
    const auto wire = joined(bob);
    EXPECT_EQ(runConsoleLine(server_->state(), "ban bob \"\""), "Bob is banned");
    EXPECT_EQ(refusalOf(*wire), Refusal::Banned);
    ClientIdentity renamed = bob;
    renamed.name = "Rob";
    TestWire again(*server_);
    EXPECT_EQ(refusalOfLogin(again, greetedLogin(again, renamed)), Refusal::Banned) << "the key is banned";
    EXPECT_EQ(refusalOfName("Bob"), Refusal::Name) << "and its name is not free";
    // Also between Login and Proof.
    const ClientIdentity cid = testIdentity("Cid");
    joined(cid)->close();
    TestWire late(*server_);
    late.say(greetedLogin(late, cid));
    (void)late.take();
    EXPECT_EQ(runConsoleLine(server_->state(), "ban Cid for a reason"), "Cid is banned");
    late.say(Proof{server_->state().offer.digests});
    EXPECT_EQ(refusalOf(late), Refusal::Banned);
}

TEST_F(HostileLogin, AFullServerTakesOperatorsAndThoseWhoAreThere) {
    ServerSettings settings;
    settings.maxPlayers = 2;
    start(settings);
    const ClientIdentity op = testIdentity("Op"), bob = testIdentity("Bob");
    joined(op)->close();
    EXPECT_EQ(runConsoleLine(server_->state(), "op Op"), "Op is an operator now");
    const auto first = joined(bob);
    EXPECT_EQ(refusalOfName("Cid"), Refusal::Full);
    const auto operators = joined(op);
    const auto second = joined(bob);
    EXPECT_EQ(refusalOf(*first), Refusal::Replaced);
    EXPECT_TRUE(plays(*second) && plays(*operators));
    EXPECT_EQ(server_->state().clients.playing.size(), 3u);
}

TEST_F(HostileLogin, WhoComesAgainMayDoWhatWasLeft) {
    start();
    const ClientIdentity bob = testIdentity("Bob");
    auto wire = joined(bob);
    while (clientOf(*wire).buckets.chat.take(1, server_->now)) {
    }
    wire->close();
    wire = joined(bob);
    EXPECT_FALSE(clientOf(*wire).buckets.chat.take(1, server_->now)) << "it has talked enough";
    int joins = 2;
    for (bool isIn = true; isIn && joins < 100; joins += isIn) {
        wire->close();
        wire = std::make_unique<TestWire>(*server_);
        isIn = std::holds_alternative<Joined>(logIn(*wire, bob));
    }
    EXPECT_EQ(joins, 10);
    wire->close();
    server_->now += std::chrono::seconds(6);
    EXPECT_TRUE(plays(*joined(bob)));
}

TEST_F(HostileLogin, PlayersOfAnAddressAreFew) {
    ServerSettings settings;
    settings.maxPlayersOfAddress = 2;
    start(settings);  // Ann counts for the address "test"
    const ClientIdentity bob = testIdentity("Bob");
    const auto first = joined(bob);
    EXPECT_EQ(refusalOfName("Cid"), Refusal::Full);
    const auto again = joined(bob);
    EXPECT_TRUE(plays(*again));
    again->close();
    EXPECT_TRUE(plays(*joined("Cid")));
}

TEST_F(HostileLogin, NewPlayersOfAnAddressAreFew) {
    ServerSettings settings;
    settings.newPlayersPerHour = 3;
    start(settings);  // Ann is the first player of the address "test"
    const ClientIdentity bob = testIdentity("Bob");
    joined(bob)->close();
    joined(testIdentity("Cid"))->close();
    EXPECT_EQ(refusalOfName("Dan"), Refusal::Full);
    EXPECT_EQ(server_->state().clients.known.byName("Dan"), nullptr);
    EXPECT_TRUE(plays(*joined(bob)));  // a known player may return
    server_->now += std::chrono::minutes(20);
    EXPECT_TRUE(plays(*joined(testIdentity("Dan"))));
}

TEST_F(HostileLogin, Passwords) {
    start();
    EXPECT_EQ(runConsoleLine(server_->state(), "password secret"), "the password is set");
    ClientIdentity bob = testIdentity("Bob");
    for (const char* password : {"", "Secret", "secret"}) {
        bob.password = password;
        TestWire wire(*server_);
        wire.say(greetedLogin(wire, bob));
        waitForPassword(wire);
        const bool isRight = bob.password == "secret";
        EXPECT_EQ(refusalOf(wire), isRight ? Refusal::Count : Refusal::Password) << password;
        EXPECT_EQ(clientOf(wire).stage, isRight ? ServerClient::Stage::Proof : ServerClient::Stage::Closed);
        wire.close();
    }
    EXPECT_EQ(runConsoleLine(server_->state(), "password off"), "no password is needed");
    EXPECT_EQ(refusalOfName("Bob"), Refusal::Count);
}

TEST_F(HostileLogin, GuessesOfThoseWhoAreGoneKeepNobodyWaiting) {
    start();
    EXPECT_EQ(runConsoleLine(server_->state(), "password secret"), "the password is set");
    for (int k = 0; k < 100; ++k) {
        TestWire wire(*server_);
        wire.say(greetedLogin(wire, testIdentity("Mallory")));
        wire.close();
    }
    ClientIdentity bob = testIdentity("Bob");
    bob.password = "secret";
    TestWire wire(*server_);
    wire.say(greetedLogin(wire, bob));
    EXPECT_EQ(refusalOf(wire), Refusal::Count);
    waitForPassword(wire);
    EXPECT_EQ(clientOf(wire).stage, ServerClient::Stage::Proof);
    EXPECT_LE(server_->state().password.queue.size(), 1u);
}

TEST_F(HostileLogin, ASlowLoginAndASilentPlayerEnd) {
    start();
    const auto bob = joined("Bob");
    TestWire silent(*server_), greeted(*server_), offered(*server_);
    greeted.say(helloOf(testIdentity("Cid")));
    offered.say(greetedLogin(offered, testIdentity("Dan")));
    for (int k = 0; k < 500; ++k) {  // 25 s of server time
        ann_->say(Pong{0});
        server_->tick();
    }
    for (TestWire* wire : {bob.get(), &silent, &greeted, &offered})
        EXPECT_EQ(refusalOf(*wire), Refusal::Silent);
    EXPECT_TRUE(plays(*ann_));
}

// ——— messages at the wrong stage

const std::vector<ClientMessage>& oneOfEach() {
    static const std::vector<ClientMessage> messages{Hello{},
                                                     Login{"Zoe", {}, {}, {}},
                                                     Proof{},
                                                     View{{0, 0}, 2, 0},
                                                     Move{},
                                                     Edit{1, {}, world::UseBlock{}, {}},
                                                     Fill{1, {}},
                                                     Place{1, {}, {}},
                                                     TakeBack{1, false},
                                                     Say{"x"},
                                                     Pong{0},
                                                     AskPlayers{},
                                                     Leave{},
                                                     AskPack{0, 0},
                                                     ItemCommand{1, game::SelectSlot{3}}};
    return messages;
}

TEST_F(HostileLogin, EachMessageAtEachStage) {
    start();
    using Stage = ServerClient::Stage;
    ASSERT_EQ(oneOfEach().size(), std::variant_size_v<ClientMessage>) << "a message of each kind";
    int number = 0;
    for (const Stage stage :
         {Stage::Hello, Stage::Login, Stage::Password, Stage::Proof, Stage::Playing, Stage::Closed})
        for (const ClientMessage& message : oneOfEach()) {
            TestWire wire(*server_);
            const ClientIdentity bob = testIdentity(fmt::format("Bob{}", ++number));
            if (stage == Stage::Playing) {
                (void)logIn(wire, bob);
            } else if (stage == Stage::Closed) {
                wire.say(Leave{});
            } else if (stage != Stage::Hello) {
                const Login login = greetedLogin(wire, bob);
                if (stage == Stage::Proof) wire.say(login);
                if (stage == Stage::Password) clientOf(wire).stage = Stage::Password;
            }
            (void)wire.take();
            ASSERT_EQ(clientOf(wire).stage, stage);
            wire.say(message);
            // Hello, Login, Proof
            const bool isLogin = message.index() <= 2 || std::holds_alternative<AskPack>(message);
            Refusal expected = (stage == Stage::Playing) == isLogin ? Refusal::ProtocolError : Refusal::Count;
            if (stage != Stage::Playing) expected = Refusal::ProtocolError;
            if (stage == Stage::Closed) expected = Refusal::Count;
            if (stage == Stage::Hello && message.index() == 0) expected = Refusal::Count;
            if (stage == Stage::Login && message.index() == 1) expected = Refusal::WrongKey;
            if (stage == Stage::Proof && message.index() == 2) expected = Refusal::OtherWorld;
            EXPECT_EQ(refusalOf(wire), expected)
                << nameOf(message) << " at stage " << static_cast<int>(stage);
            wire.close();
        }
}

}  // namespace
}  // namespace terrane::net
