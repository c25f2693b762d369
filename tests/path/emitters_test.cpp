#include "terrane/path/emitters.h"

#include <gtest/gtest.h>

#include <map>

namespace terrane::path {
namespace {

Emitter faceAt(glm::dvec3 corner, float power, int block) {
    return {.tile = {0, 0},
            .block = block,
            .corner = corner,
            .alongU = {1, 0, 0},
            .alongV = {0, 1, 0},
            .normal = {0, 0, 1},
            .area = 1,
            .power = power};
}

// Every face has a chance wherever a point is, and it is as large as chanceOf() says.
TEST(EmitterTableTest, ChancesAreThoseOfChoices) {
    std::vector<Emitter> faces;
    for (int k = 0; k < 40; ++k)
        faces.push_back(faceAt({k * 7 % 90 - 30, k * 13 % 50, k * 5 % 60}, static_cast<float>(1 + k % 5), k));
    const EmitterTable table(faces);
    constexpr int kCount = 200'000;
    for (const glm::dvec3 point : {glm::dvec3(5, 5, 5), glm::dvec3(-31.5, 40, 20), glm::dvec3(900, 900, 0)}) {
        std::map<int, int> chosen;
        int none = 0;
        Random random;
        for (int k = 0; k < kCount; ++k) {
            random.sample = static_cast<std::uint32_t>(k);
            random.dimension = 0;
            const auto choice = table.choose(point, random);
            if (!choice) {
                ++none;
                continue;
            }
            ++chosen[choice->emitter->block];
            ASSERT_EQ(choice->chance, table.chanceOf(*choice->emitter, point));
        }
        double sum = static_cast<double>(none) / kCount;
        for (int k = 0; k < 40; ++k) {
            const Emitter* face = table.find({0, 0}, k, 0);
            ASSERT_NE(face, nullptr);
            const double chance = double{table.chanceOf(*face, point)};
            EXPECT_GT(chance, 0);
            EXPECT_NEAR(static_cast<double>(chosen[k]) / kCount, chance, 5 * std::sqrt(chance / kCount));
            sum += chance;
        }
        EXPECT_NEAR(sum, 1, 0.01);
    }
    EXPECT_EQ(table.find({1, 0}, 3, 0), nullptr);
    EXPECT_EQ(table.find({0, 0}, 3, 1), nullptr);
}

TEST(EmitterTableTest, NothingIsChosenFromNothing) {
    Random random;
    EXPECT_FALSE(EmitterTable().choose({0, 0, 0}, random));
    EXPECT_EQ(EmitterTable().find({0, 0}, 0, 0), nullptr);
}

}  // namespace
}  // namespace terrane::path
