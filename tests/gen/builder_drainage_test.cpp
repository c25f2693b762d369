// Mistakes in drainage maps in a generator's recording.
#include "tests/gen/drainage_land.h"

namespace terrane::gen {
namespace {

std::string mistake(const Write& write) {
    const auto graph = tryToBuild([&](GeneratorBuilder& g) {
        write(g);
        g.pass3D("last", [](Pass&) {});
    });
    return graph ? "" : graph.error().message;
}

std::string mistakeOf(const DrainageSpec& spec) {
    return mistake(
        [&](GeneratorBuilder& g) { g.drainage("rivers", spec, [](Pass&) { return Float(1.0f); }); });
}

TEST(BuilderDrainage, RefusesNumbersOutOfRange) {
    const std::string start = "generator \"test\": drainage \"rivers\": ";
    EXPECT_EQ(mistakeOf({}), "");
    EXPECT_EQ(mistakeOf({.spacing = 100}), start + "spacing 100 is not a power of two in 64…1024");
    EXPECT_EQ(mistakeOf({.spacing = 32}), start + "spacing 32 is not a power of two in 64…1024");
    EXPECT_EQ(mistakeOf({.minFlow = 65}), start + "minFlow 65 is not in 1…64");
    EXPECT_EQ(mistakeOf({.halfWidth = 20.0f}), start + "halfWidth 20 is not in 0.5…14, its maximum");
    EXPECT_EQ(mistakeOf({.maxHalfWidth = 65.0f}), start + "maxHalfWidth 65 is not in 0.5…64");
    EXPECT_EQ(mistakeOf({.reach = 300.0f}), start + "reach 300 is not in 1…256, the spacing");
    EXPECT_EQ(mistakeOf({.bend = 0.5f}), start + "bend 0.5 is not in 0…0.25");
    EXPECT_EQ(mistakeOf({.seaLevel = 3000.0f}), start + "seaLevel 3000 is not in -2048…2047");
    EXPECT_EQ(mistakeOf({.lakeDepth = -1.0f}), start + "lakeDepth -1 is not in 0…1024");
    EXPECT_EQ(mistakeOf({.maxCut = 2000.0f}), start + "maxCut 2000 is not in 0…1024");
}

TEST(BuilderDrainage, RefusesWhatHeightsCannotUse) {
    const auto of = [](const std::function<Float(Pass&, Field<Float>)>& height) {
        return mistake([&](GeneratorBuilder& g) {
            const auto field = g.field<Float>("ground");
            g.pass2D("land", [&](Pass& p) { p.set(field, Float(3.0f)); });
            g.drainage("rivers", {}, [&](Pass& p) { return height(p, field); });
        });
    };
    EXPECT_EQ(of([](Pass& p, Field<Float>) { return Float(p.z()); }),
              "generator \"test\": drainage \"rivers\": pass \"heights\": z: only in 3D passes");
    EXPECT_EQ(of([](Pass& p, Field<Float> f) { return p.read(f); }),
              "generator \"test\": drainage \"rivers\": pass \"heights\": field \"ground\" is read, but no "
              "earlier pass writes it");
    EXPECT_EQ(of([](Pass& p, Field<Float> f) {
                  p.set(f, Float(1.0f));
                  return Float(2.0f);
              }),
              "generator \"test\": drainage \"rivers\": its heights write a field");
    EXPECT_EQ(of([](Pass& p, Field<Float>) { return p.drainage({0}).level; }),
              "generator \"test\": drainage \"rivers\": pass \"heights\": drainage: this generator has no "
              "such map");
}

TEST(BuilderDrainage, RefusesMapsInTheWrongPlace) {
    const auto flat = [](Pass&) { return Float(1.0f); };
    EXPECT_EQ(mistake([&](GeneratorBuilder& g) {
                  const Drainage map = g.drainage("rivers", {}, flat);
                  g.pass3D("ground", [&](Pass& p) {
                      p.setBlock(select(p.drainage(map).distance < 1.0f, p.block("water"), p.block("air")));
                  });
              }),
              "generator \"test\": pass \"ground\": drainage \"rivers\": only in 2D passes");
    EXPECT_EQ(mistake([&](GeneratorBuilder& g) {
                  const auto field = g.field<Float>("ground");
                  g.pass2D("land", [&](Pass& p) { p.set(field, p.drainage({5}).level); });
              }),
              "generator \"test\": pass \"land\": drainage: this generator has no such map");
    EXPECT_EQ(mistake([&](GeneratorBuilder& g) {
                  g.drainage("rivers", {}, flat);
                  g.drainage("rivers", {}, flat);
              }),
              "generator \"test\": drainage \"rivers\": declared twice");
    EXPECT_EQ(mistake([&](GeneratorBuilder& g) {
                  const auto field = g.field<Float>("ground");
                  g.drainage("rivers", {}, [](Pass& p) { return p.perlin2D("land", 256, {1.0f}); });
                  g.pass2D("land", [&](Pass& p) { p.set(field, p.perlin2D("land", 128, {1.0f})); });
              }),
              "generator \"test\": pass \"land\": noise \"land\" is used twice with different parameters");
}

}  // namespace
}  // namespace terrane::gen
