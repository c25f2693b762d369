#include "terrane/rays/cast.h"

#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrane/rays/cast.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace terrane::rays {
namespace HWY_NAMESPACE {

void castAll(shared::RayWords scene, const shared::Ray* rays, shared::RayHit* hits, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) hits[k] = shared::castRay(scene, rays[k]);
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::rays
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace terrane::rays {

HWY_EXPORT(castAll);

void castRays(shared::RayWords scene, std::span<const shared::Ray> rays, std::span<shared::RayHit> hits) {
    assert(rays.size() == hits.size() && "a hit for each ray");
    HWY_DYNAMIC_DISPATCH(castAll)(scene, rays.data(), hits.data(), rays.size());
}

}  // namespace terrane::rays
#endif
