#include "terrane/path/denoise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace terrane::path {
namespace {

constexpr float kLeastAlbedo = 0.02f;    // light of darker surfaces is not parted from their color
constexpr float kNormalSharpness = 16;   // by the square of the difference
constexpr float kDepthTolerance = 0.6f;  // of the change of depth that neighbors lead one to expect
constexpr float kLightTolerance = 3;     // standard deviations
constexpr std::array<float, 3> kKernel{3.0f / 8, 1.0f / 4, 1.0f / 16};

struct Light {
    std::vector<glm::vec3> color;
    std::vector<float> variance;
};

glm::vec3 partedBy(glm::vec3 albedo) {
    return glm::max(albedo, kLeastAlbedo);
}

class Filter {
  public:
    explicit Filter(const Means& means) : means_(means) {}

    // One pixel after a pass whose neighbors are `step` pixels apart.
    void apply(const Light& from, Light& to, glm::ivec2 pixel, int step) const {
        const std::size_t at = indexOf(pixel);
        const float center = luminance(from.color[at]);
        const float spread = kLightTolerance * std::sqrt(variance(from, pixel)) + 1e-4f;
        const float slope = slopeAt(pixel);
        glm::vec3 sum(0);
        float weights = 0, variances = 0;
        for (int dy = -2; dy <= 2; ++dy) {
            for (int dx = -2; dx <= 2; ++dx) {
                const glm::ivec2 there = pixel + step * glm::ivec2(dx, dy);
                if (!isInside(there)) continue;
                const std::size_t k = indexOf(there);
                const float steps = static_cast<float>(step * std::max(std::abs(dx), std::abs(dy)));
                float weight = kKernel[static_cast<std::size_t>(std::abs(dx))] *
                               kKernel[static_cast<std::size_t>(std::abs(dy))];
                if (k != at)
                    weight *= std::exp(-std::abs(luminance(from.color[k]) - center) / spread -
                                       difference(at, k, slope * steps));
                sum += weight * from.color[k];
                variances += weight * weight * from.variance[k];
                weights += weight;
            }
        }
        to.color[at] = sum / weights;
        to.variance[at] = variances / (weights * weights);
    }

  private:
    bool isInside(glm::ivec2 p) const {
        return p.x >= 0 && p.y >= 0 && p.x < means_.size.x && p.y < means_.size.y;
    }
    std::size_t indexOf(glm::ivec2 p) const { return static_cast<std::size_t>(p.y * means_.size.x + p.x); }

    // Smoothed over 3 × 3 pixels: a few samples say little about it.
    float variance(const Light& light, glm::ivec2 pixel) const {
        float sum = 0, count = 0;
        for (int k = 0; k < 9; ++k) {
            const glm::ivec2 there = pixel + glm::ivec2(k % 3 - 1, k / 3 - 1);
            if (!isInside(there)) continue;
            sum += light.variance[indexOf(there)];
            ++count;
        }
        return sum / count;
    }

    // Change of depth from pixel to pixel, the smaller one to both sides: surfaces have edges.
    float slopeAt(glm::ivec2 pixel) const {
        const float depth = means_.depth[indexOf(pixel)];
        float slope = 0;
        for (const glm::ivec2 axis : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
            float least = 1e9f;
            for (const int side : {-1, 1})
                if (isInside(pixel + side * axis))
                    least = std::min(least, std::abs(means_.depth[indexOf(pixel + side * axis)] - depth));
            slope = std::max(slope, least < 1e9f ? least : 0);
        }
        return slope;
    }

    float difference(std::size_t a, std::size_t b, float expectedDepth) const {
        if ((means_.depth[a] > 0) != (means_.depth[b] > 0)) return 1e3f;
        const glm::vec3 normal = means_.normal[a] - means_.normal[b];
        const float depth = std::abs(means_.depth[a] - means_.depth[b]);
        return kNormalSharpness * glm::dot(normal, normal) +
               depth / (expectedDepth / kDepthTolerance + 0.01f * means_.depth[a] + 1e-3f);
    }

    const Means& means_;
};

}  // namespace

void denoise(Means& means, base::JobSystem& jobs) {
    Light light, next;
    for (std::size_t k = 0; k < means.radiance.size(); ++k) {
        const glm::vec3 albedo = partedBy(means.albedo[k]);
        const float scale = luminance(albedo);
        light.color.push_back(means.radiance[k] / albedo);
        light.variance.push_back(means.variance[k] / (3 * scale * scale));
    }
    next = light;
    const Filter filter(means);
    for (int step = 1; step <= 16; step *= 2) {
        const auto row = [&](std::size_t y) {
            for (int x = 0; x < means.size.x; ++x) filter.apply(light, next, {x, static_cast<int>(y)}, step);
        };
        (void)base::parallelFor(jobs, static_cast<std::size_t>(means.size.y), row);
        std::swap(light, next);
    }
    for (std::size_t k = 0; k < means.radiance.size(); ++k)
        // The sky has no noise, and no albedo.
        if (means.depth[k] > 0) means.radiance[k] = light.color[k] * partedBy(means.albedo[k]);
}

}  // namespace terrane::path
