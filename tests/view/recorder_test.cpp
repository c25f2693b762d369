#include "terrane/view/recorder.h"

#include <gtest/gtest.h>

#include "terrane/world/character.h"

namespace terrane::view {
namespace {

// Walks 8 blocks along x in 4 s, stands for 2 s, and builds from 4.5 s to 5.5 s.
Shot shotOfAWalk() {
    Shot shot{.name = "",
              .seconds = 10,
              .path = CameraPath({CameraKey{}}),
              .options = {},
              .titles = {},
              .edits = {},
              .players = {}};
    CameraKey from, to, last;
    from.position = {0, 3, 70};
    to.position = last.position = {8, 3, 70};
    to.time = 4;
    last.time = 6;
    shot.players = {{"Ann", 3, CameraPath({from, to, last})}};
    shot.edits = {{.time = 4.5, .seconds = 1, .box = {{9, 3, 70}, {9, 3, 72}}, .block = 1, .player = "Ann"}};
    return shot;
}

TEST(ShotFigures, FollowTheirPathOnFoot) {
    const Shot shot = shotOfAWalk();
    const world::Figure start = figuresAt(shot, 0)[0], walks = figuresAt(shot, 2)[0],
                        stands = figuresAt(shot, 5.9)[0];
    EXPECT_EQ(start.eyes, glm::dvec3(0, 3, 70 + world::kEyeHeight));
    EXPECT_NEAR(walks.eyes.x, shot.players[0].path.at(2).camera.position.x, 0.3);
    EXPECT_GT(walks.strideSize, 0.3f);
    EXPECT_NEAR(stands.eyes.x, 8, 0.01);
    EXPECT_LT(stands.strideSize, 0.01f);
    EXPECT_EQ(stands.look, 3u);
}

TEST(ShotFigures, NoneSkipsAStep) {
    const Shot shot = shotOfAWalk();
    double before = 0;
    for (int frame = 1; frame <= 100; ++frame) {
        const double x = figuresAt(shot, frame / 24.0)[0].eyes.x;
        EXPECT_GE(x, before) << frame;
        EXPECT_LT(x - before, 0.2) << frame;
        before = x;
    }
}

TEST(ShotFigures, SwingTheArmWhileTheyBuild) {
    Shot shot = shotOfAWalk();
    EXPECT_EQ(figuresAt(shot, 4.4)[0].swing, 0);
    for (const double seconds : {4.6, 4.75, 5.0, 5.35})
        EXPECT_GT(figuresAt(shot, seconds)[0].swing, 0) << seconds;
    EXPECT_EQ(figuresAt(shot, 5.95)[0].swing, 0);
    shot.edits[0].player = "Bob";
    EXPECT_EQ(figuresAt(shot, 5)[0].swing, 0) << "another player's edit";
}

const EditCue kBox{.time = 0, .seconds = 4, .box = {{-1, 5, 70}, {1, 6, 73}}, .block = 1};

TEST(EditPlayer, BlocksComeOneAfterTheOther) {
    EXPECT_EQ(blocksDone(kBox, -0.1), 0);
    EXPECT_EQ(blocksDone(kBox, 0), 0);
    EXPECT_EQ(blocksDone(kBox, 1), 6);
    EXPECT_EQ(blocksDone(kBox, 3.99), 23);
    EXPECT_EQ(blocksDone(kBox, 4), 24);
    EXPECT_EQ(blocksDone(kBox, 100), 24);
}

TEST(EditPlayer, WithoutTimeAllComeAtOnce) {
    EditCue edit = kBox;
    edit.seconds = 0;
    EXPECT_EQ(blocksDone(edit, -0.01), 0);
    EXPECT_EQ(blocksDone(edit, 0), 24);
}

TEST(Recorder, TitlesFadeInAndOut) {
    const TitleCue title{.time = 3, .seconds = 4, .text = "a"};
    EXPECT_EQ(titleStrength(title, -1), 0);
    EXPECT_EQ(titleStrength(title, 0), 0);
    EXPECT_FLOAT_EQ(titleStrength(title, 0.25), 0.5f);
    EXPECT_EQ(titleStrength(title, 2), 1);
    EXPECT_FLOAT_EQ(titleStrength(title, 3.75), 0.5f);
    EXPECT_EQ(titleStrength(title, 4.1), 0);
}

}  // namespace
}  // namespace terrane::view
