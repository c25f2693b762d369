#include "terrane/render/figure_records.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "terrane/world/character.h"

namespace terrane::render {
namespace {

// Players may stand at one place, as at the spawn: from inside a figure the camera would see back faces.
bool isWithin(const world::Figure& figure, const glm::dvec3& camera) {
    constexpr double kAside = 0.4, kUnder = world::kEyeHeight + 0.1, kOver = 0.3;  // of the eyes
    const glm::dvec3 from = camera - figure.eyes;
    return std::abs(from.x) < kAside && std::abs(from.y) < kAside && from.z > -kUnder && from.z < kOver;
}

shared::FigureRecord recordOf(const world::Figure& figure, glm::vec3 feet) {
    shared::FigureRecord record{};
    record.feet = glm::vec4(feet, glm::radians(figure.bodyYaw));
    record.pose = {glm::radians(figure.yaw), glm::radians(figure.pitch), figure.stride, figure.strideSize};
    record.swing = figure.swing;
    record.look = figure.look;
    return record;
}

}  // namespace

std::vector<shared::FigureRecord> figureRecords(std::span<const world::Figure> figures, const Camera& camera,
                                                std::span<const glm::vec4> planes, double farBlocks) {
    const glm::dvec3 corner = cornerOfChunk(cameraChunk(camera)) + glm::dvec3(0, 0, world::kEyeHeight);
    struct Seen {
        double distance;
        shared::FigureRecord record;
    };
    std::vector<Seen> seen;
    for (const world::Figure& figure : figures) {
        const double distance = glm::distance(figure.eyes, camera.position);
        const glm::vec3 feet(figure.eyes - corner);
        if (isWithin(figure, camera.position)) continue;
        if (distance < farBlocks && mayBeVisible(planes, feet + kFigureLow, feet + kFigureHigh))
            seen.push_back({distance, recordOf(figure, feet)});
    }
    std::ranges::stable_sort(seen, {}, &Seen::distance);
    if (seen.size() > shared::kMostFigures) seen.resize(shared::kMostFigures);
    std::vector<shared::FigureRecord> records;
    records.reserve(seen.size());
    for (const Seen& s : seen) records.push_back(s.record);
    return records;
}

}  // namespace terrane::render
