#include "apps/terrane/window/title/new_world_form.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>

#include "terrane/base/digest.h"
#include "terrane/io/open_session.h"
#include "tests/base/temp_folder.h"

namespace terrane::app {
namespace {

using testing::HasSubstr;

class NewWorld : public testing::Test {
  protected:
    std::string problemOf(const NewWorldForm& form) {
        const auto world = worldOf(form, folder_.path());
        return world ? "" : world.error().message;
    }

    base::TempFolder folder_;
    pack::Content content_ = io::loadContent({}).value();
    NewWorldForm form_ = newForm(folder_.path(), 5, content_);
};

TEST_F(NewWorld, AFormThatNobodyTouchedMakesAWorld) {
    const auto world = worldOf(form_, folder_.path());
    ASSERT_TRUE(world);
    EXPECT_EQ(world->file, folder_.path() / "World.sqlite");
    EXPECT_EQ(world->seed->seed, 5u);
    EXPECT_EQ(world->generator, gen::kDefaultGenerator);
    std::ofstream(world->file) << "there";
    EXPECT_EQ(newForm(folder_.path(), 5, content_).name, "World 2");
    EXPECT_EQ(problemOf(form_), "there is a world \"World\" already");
}

TEST_F(NewWorld, ASeedIsANumberOrAText) {
    form_.seed = " 12 ";
    EXPECT_EQ(seedOf(form_)->seed, 12u);
    EXPECT_EQ(seedOf(form_)->text, "");
    form_.seed = "a hill";
    EXPECT_EQ(seedOf(form_)->seed, base::hash64("a hill"));
    EXPECT_EQ(seedOf(form_)->text, "a hill");
    form_.seed = "18446744073709551615";
    EXPECT_EQ(seedOf(form_)->seed, UINT64_MAX);
    form_.seed = "18446744073709551616";
    EXPECT_THAT(problemOf(form_), HasSubstr("seed: expected a whole number from -9223372036854775808 to "
                                            "18446744073709551615"));
    form_.seed = "\t ";
    EXPECT_EQ(seedOf(form_)->seed, 5u);
}

TEST_F(NewWorld, ASeedSaysWhichNumberItIsOnlyIfItDoesNotShowIt) {
    const auto note = [&](const std::string& text) {
        form_.seed = text;
        return seedNote(form_, seedOf(form_).value(), textsOf("en"));
    };
    EXPECT_EQ(note(""), "Random number 5");
    EXPECT_EQ(note("  "), "Random number 5");
    EXPECT_EQ(note("12"), "");
    EXPECT_EQ(note(" -1 "), "");
    EXPECT_EQ(note("a hill"), fmt::format("The text becomes the number {}", base::hash64("a hill")));
}

TEST_F(NewWorld, HeightsAreTheGeneratorsUnlessTyped) {
    EXPECT_EQ(heightsOf(form_).value(),
              gen::heightsOf(gen::kDefaultGenerator, *content_.blocks, {}, content_.generators).value());
    const auto requested = [&] { return worldOf(form_, folder_.path())->heights; };
    EXPECT_FALSE(requested().bottom || requested().top);
    form_.declared = {-1024, 1792};
    EXPECT_EQ(heightsOf(form_).value(), (world::Heights{-1024, 1792}));
    form_.bottom = " -64 ";
    EXPECT_EQ(heightsOf(form_).value(), (world::Heights{-64, 1792}));
    EXPECT_EQ(requested().bottom, -64);
    EXPECT_FALSE(requested().top);
    form_.top = "320";
    EXPECT_EQ(heightsOf(form_).value(), (world::Heights{-64, 320}));
    EXPECT_EQ(requested().top, 320);
}

TEST_F(NewWorld, HeightsThatNoWorldHasAreRefused) {
    chooseGenerator(form_, "flat", content_);
    for (const char* text : {"3", "-2064", "2064", "256", "high", "1e3", "99999999999", "16.0", "16 32"}) {
        form_.bottom = text;
        EXPECT_FALSE(heightsOf(form_)) << text;
        EXPECT_THAT(problemOf(form_), HasSubstr("multiples of 16 from -2048 to 2048")) << text;
        EXPECT_EQ(problemOf(form_).find('\n'), std::string::npos);
    }
    form_.bottom = "";
    form_.top = "0";
    EXPECT_THAT(problemOf(form_), HasSubstr("the bottom below the top"));
}

TEST_F(NewWorld, AGeneratorBringsItsHeights) {
    io::WorldOptions options;
    options.content = {std::string(TERRANE_SOURCE_DIR) + "/examples/lua"};
    const auto content = io::loadContent(options);
    ASSERT_TRUE(content);
    chooseGenerator(form_, "examples:tall", *content);
    EXPECT_EQ(form_.generator, "examples:tall");
    EXPECT_EQ(form_.declared, (world::Heights{-1024, 1792}));
    chooseGenerator(form_, "flat", *content);
    EXPECT_EQ(form_.declared, world::Heights());
}

TEST_F(NewWorld, NamesThatNoFileCanHaveAreRefused) {
    for (const char* name : {"", "   ", "../x", "a/b", ".a", "a.sqlite", "a\nb"}) {
        form_.name = name;
        EXPECT_NE(problemOf(form_), "") << name;
        EXPECT_EQ(problemOf(form_).find('\n'), std::string::npos);
    }
    form_.name = std::string(101, 'a');
    EXPECT_NE(problemOf(form_), "");
    form_.name = " My world ";
    EXPECT_EQ(worldOf(form_, folder_.path())->file, folder_.path() / "My world.sqlite");
}

}  // namespace
}  // namespace terrane::app
