// Invalid lines of the console and of operators, and their answers.
#include "tests/net/hostile_fixture.h"

#include <random>

#include "terrane/net/server/server_clients.h"

namespace terrane::net {
namespace {

class HostileConsole : public HostileTest {
  protected:
    std::string run(std::string_view line) { return runConsoleLine(server_->state(), line); }
};

TEST_F(HostileConsole, PlayersGiveNoCommands) {
    start();
    const auto bob = joined("Bob");
    (void)bob->take();
    for (const char* line : {"/stop", "/op Bob", "/kick Ann", "/", "/ stop", "/password x"})
        bob->say(Say{line});
    std::size_t told = 0;
    for (const ServerMessage& message : bob->take()) {
        const auto* said = std::get_if<Said>(&message);
        told += said && said->text == "only operators can give commands";
    }
    EXPECT_EQ(told, 6u);
    EXPECT_FALSE(server_->state().isStopping);
    EXPECT_TRUE(server_->state().password.hash.empty());
    EXPECT_EQ(clientOf(*bob).role, game::Role::Player);
}

// Answers may have several and long lines: all of them arrive as valid messages.
TEST_F(HostileConsole, OperatorsReadTheAnswers) {
    start();
    const auto bob = joined("Bob");
    (void)run("op Bob");
    (void)bob->take();
    bob->say(Say{"/help"});
    std::string text;
    for (const ServerMessage& message : bob->take()) text += std::get<Said>(message).text + "\n";
    EXPECT_EQ(text, consoleHelp() + "\n");
    bob->say(Say{"/list"});
    EXPECT_EQ(bob->take().size(), 3u) << "a line each";
    bob->say(Say{"/kick Bob"});
    EXPECT_EQ(refusalOf(*bob), Refusal::Kicked);
}

TEST_F(HostileConsole, WhatIsSaidFitsAMessage) {
    start();
    std::string wide = "say ";
    for (int k = 0; k < 300; ++k) wide += "ü";
    for (const std::string& line :
         {wide, std::string("say a\x1b[2J"), std::string("say \xff\xfe"), "say x" + wide}) {
        (void)ann_->take();
        EXPECT_EQ(run(line), "said");
        EXPECT_TRUE(findMessage<Said>(ann_->take()));
    }
    const ClientIdentity bob = testIdentity("Bob");
    for (const std::string& command : {std::string("kick Bob "), std::string("ban Bob ")})
        for (const std::string& reason :
             {std::string("\xc3"), std::string("a\nb"), std::string(1000, 'x'), "x" + wide}) {
            (void)run("unban Bob");
            const auto wire = joined(bob);
            (void)run(command + reason);
            const auto refused = refusedIn(wire->take());
            ASSERT_TRUE(refused) << reason;
            EXPECT_TRUE(refused->reason.starts_with("you ")) << refused->reason;
            wire->close();
        }
}

TEST_F(HostileConsole, OddLines) {
    start();
    const auto bob = joined("Bob");
    for (const char* line : {"kick",
                             "kick \"\"",
                             "kick \"",
                             "ban nobody",
                             "op \"Ann",
                             "claim",
                             "claim x 1 2 3",
                             "claim x 1 2 3 4",
                             "claim x 1 2 3 4 nobody",
                             "claim x 99999999999 0 0 0 Ann",
                             "claim x 1.5 0 0 0 Ann",
                             "claim \"\" 0 0 0 0 Ann",
                             "claim x -2147483649 0 0 0 Ann",
                             "unclaim x",
                             "rollback Bob",
                             "rollback Bob nan",
                             "rollback Bob -1",
                             "rollback Bob 1e300",
                             "rollback Bob 5 1 2 3",
                             "rollback Bob 5 1 2 3 x",
                             "rollback nobody 5",
                             "time",
                             "time nan",
                             "time 1",
                             "time -0.1",
                             "time inf",
                             "time 1e999",
                             "password",
                             "password \"\"",
                             "nothing",
                             "\"\"",
                             "help me"})
        EXPECT_FALSE(run(line).empty()) << line;
    EXPECT_EQ(run(""), "");
    EXPECT_EQ(run("   "), "");
    EXPECT_EQ(run("claim \"the hall\" -2147483648 -2147483648 2147483647 2147483647 ann"),
              "the hall is claimed for ann");
    EXPECT_EQ(run("claim \"The Hall\" 0 0 0 0 ann"),
              "the name The Hall looks like that of the claim the hall");
    EXPECT_EQ(run("claim \u3164 0 0 0 0 ann"), "a name cannot have the character U+3164");
    EXPECT_EQ(run("unclaim \"the hall\""), "the claim the hall is gone");
    EXPECT_EQ(run("claim cafe\u0301 0 0 0 0 ann"), "caf\u00e9 is claimed for ann");
    EXPECT_EQ(run("unclaim cafe\u0301"), "the claim cafe\u0301 is gone");
    EXPECT_EQ(run("time -0"), "the time is set");
    EXPECT_TRUE(server_->state().password.hash.empty()) << "no password is none";
    EXPECT_TRUE(run("password \"\x01\"").starts_with("a password")) << "nobody can type it";
    EXPECT_TRUE(server_->state().password.hash.empty());
    EXPECT_TRUE(server_->state().clients.known.claims().all().empty());
    EXPECT_TRUE(plays(*bob));
    EXPECT_FALSE(server_->state().isStopping);
}

TEST_F(HostileConsole, RandomLines) {
    start();
    std::mt19937 random(3);
    const std::vector<std::string> words{"help",     "list",
                                         "say",      "unban",
                                         "deop",     "claim",
                                         "unclaim",  "claims",
                                         "rollback", "time",
                                         "Ann",      "\"",
                                         "\"Ann\"",  "*",
                                         "0",        "-1",
                                         "0.5",      "99999999999999999999",
                                         "1e308",    "x\"y",
                                         "\xff",     "\xf0\x9f\x98\x80",
                                         "",         "   ",
                                         "a b",      "\n",
                                         "off"};
    for (int k = 0; k < 3000; ++k) {
        std::string line;
        for (std::size_t n = random() % 9; n-- > 0;)
            line += words[random() % words.size()] + (random() % 4 ? " " : "");
        (void)run(line);
        if (k % 50 == 0) (void)ann_->take();
    }
    for (const game::Claim& claim : server_->state().clients.known.claims().all())
        EXPECT_TRUE(isName(claim.name));
}

}  // namespace
}  // namespace terrane::net
