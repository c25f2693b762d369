// Drainage maps while a generator is written: their declaration, and what a pass reads of them.
#include <algorithm>
#include <bit>

#include "terrane/gen/builder.h"
#include "terrane/gen/drainage_heights.h"
#include "terrane/gen/pass.h"

namespace terrane::gen {
namespace {

bool isWithin(float v, float low, float high) {
    return v >= low && v <= high;
}

std::string mistakeIn(const DrainageSpec& s) {
    const auto spacing = static_cast<float>(s.spacing);
    if (s.spacing < 64 || s.spacing > 1024 || !std::has_single_bit(static_cast<unsigned>(s.spacing))) {
        return fmt::format("spacing {} is not a power of two in 64…1024", s.spacing);
    }
    // A node with so many steps of way above it has the next one do so too: rivers never end on land.
    if (s.minFlow < 1 || s.minFlow > kMaxUpstream) {
        return fmt::format("minFlow {} is not in 1…{}", s.minFlow, kMaxUpstream);
    }
    if (!isWithin(s.maxHalfWidth, 0.5f, 64.0f))
        return fmt::format("maxHalfWidth {} is not in 0.5…64", s.maxHalfWidth);
    if (!isWithin(s.halfWidth, 0.5f, s.maxHalfWidth)) {
        return fmt::format("halfWidth {} is not in 0.5…{}, its maximum", s.halfWidth, s.maxHalfWidth);
    }
    if (!isWithin(s.reach, 1.0f, spacing))
        return fmt::format("reach {} is not in 1…{}, the spacing", s.reach, s.spacing);
    if (!isWithin(s.bend, 0.0f, 0.25f)) return fmt::format("bend {} is not in 0…0.25", s.bend);
    if (!isWithin(s.seaLevel, 0.0f, 255.0f)) return fmt::format("seaLevel {} is not in 0…255", s.seaLevel);
    if (!isWithin(s.lakeDepth, 0.0f, 1024.0f))
        return fmt::format("lakeDepth {} is not in 0…1024", s.lakeDepth);
    if (!isWithin(s.maxCut, 0.0f, 1024.0f)) return fmt::format("maxCut {} is not in 0…1024", s.maxCut);
    return "";
}

}  // namespace

Drainage GeneratorBuilder::drainage(const std::string& name, const DrainageSpec& spec,
                                    const std::function<Float(Pass&)>& height) {
    DrainageGraph map{name, spec, {}, {}, {}};
    const auto error = [&](std::string_view message) {
        errors_.push_back(fmt::format("drainage \"{}\": {}", name, message));
    };
    if (const std::string mistake = mistakeIn(spec); !mistake.empty()) {
        error(mistake);
        map.spec = {};
    }
    auto& maps = generator_.drainages;
    if (std::any_of(maps.begin(), maps.end(), [&](const DrainageGraph& m) { return m.name == name; })) {
        error("declared twice");
    }
    // A builder of its own, of the level at which a column is a sample. It knows the fields of this one, so
    // that using them is a mistake with a name.
    GeneratorBuilder heights(name, blocks_, drainageLevel(map.spec));
    heights.noiseParameters_ = noiseParameters_;
    for (const FieldInfo& info : generator_.fields)
        heights.generator_.fields.push_back({info.name, info.type});
    const Field<Float> result = heights.field<Float>("height of drainage " + name);
    heights.pass2D("heights", [&](Pass& p) { p.set(result, height(p)); });
    for (const std::string& message : heights.errors_) error(message);
    noiseParameters_ = std::move(heights.noiseParameters_);
    map.heights = std::move(heights.generator_.passes.front());
    if (map.heights.fields.size() != 1) error("its heights write a field");
    for (auto& pass : heights.written_) written_.push_back(std::move(pass));
    map.noises = std::move(heights.generator_.noises);
    map.hashNames = std::move(heights.generator_.hashNames);
    maps.push_back(std::move(map));
    return {static_cast<std::uint32_t>(maps.size() - 1)};
}

DrainageSample Pass::drainage(Drainage map) {
    const DrainageSample none = {kNoRiver, 0.0f, 0.0f, 0.0f, kNoRiver, 0.0f};
    if (map.index >= generator_.generator_.drainages.size()) {
        error("drainage: this generator has no such map");
        return none;
    }
    const std::string& name = generator_.generator_.drainages[map.index].name;
    if (graph_.is3D) {
        error(fmt::format("drainage \"{}\": only in 2D passes", name));
        return none;
    }
    if (step() > kMaxDrainageStep) return none;
    const NoiseCall call = {NoiseKind::Drainage, name, static_cast<std::int32_t>(map.index), {}};
    const auto result = [&](std::uint32_t k) { return Float(noise(call, k, Type::Float)); };
    return {result(0), result(1), result(2), result(3), result(4), result(5)};
}

}  // namespace terrane::gen
