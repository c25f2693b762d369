#include "terrane/mesh_gpu/gpu_mesher.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

#include "terrane/base/profile.h"
#include "terrane/gpu/debug.h"
#include "terrane/gpu/fence.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/readback_buffer.h"
#include "terrane/mesh/region_quads.h"
#include "terrane/mesh_gpu/block_table.h"
#include "terrane/mesh_gpu/mesh_upload_internal.h"

namespace terrane::mesh_gpu {
namespace {

using shared::uint;

constexpr std::size_t kMaxRegions = GpuMesher::kMaxChunks * (world::kChunkHeight / mesh::kMinRegionHeight);
constexpr shared::MeshRegionCounts kNothing{{}, world::kChunkHeight, 0};
static_assert(GpuMesher::kMaxChunks * 2 * world::kSectionsPerChunk < 65536,
              "OpenGL has as many work groups along an axis at least");

base::Result<gpu::Program> compile(const gpu::ShaderLoader& shaders, bool writesQuads) {
    return gpu::Program::compute(shaders, "terrane/mesh_gpu/mesh.comp.glsl",
                                 {{"WRITES_QUADS", writesQuads ? "1" : "0"}},
                                 writesQuads ? "mesh write" : "mesh count");
}

template <class T>
gpu::Buffer bufferOf(std::span<const T> values, std::string_view label) {
    return gpu::Buffer(std::as_bytes(values), 0, label);
}

gpu::Handle<gpu::ObjectKind::Query> timestampQuery() {
    GLuint id = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &id);
    return gpu::Handle<gpu::ObjectKind::Query>(id);
}

// Counts are in the order of mesh::rangesOf().
mesh::RegionMesh regionOf(const shared::MeshRegionCounts& counts) {
    mesh::RegionMesh region;
    uint first = 0;
    std::size_t next = 0;
    for (int context = 0; context < mesh::kContextCount; ++context) {
        for (int group = 0; group < mesh::kGroupCount; ++group) {
            const bool hasRange = !mesh::contextTwoSided(context) || group == mesh::kGroupAlways;
            const uint count = hasRange ? counts.quads[next++] : 0;
            region.groups[context][group] = {first, count};
            first += count;
        }
    }
    if (counts.minZ < counts.maxZ) {
        region.minZ = static_cast<int>(counts.minZ);
        region.maxZ = static_cast<int>(counts.maxZ);
    }
    return region;
}

}  // namespace

struct GpuMesher::Impl {
    explicit Impl(const world::BlockRegistry& blocks)
        : table(blocks),
          upload(table),
          types(bufferOf(std::span<const shared::MeshType>(table.types), "mesh types")),
          growth(bufferOf(std::span<const uint>(table.growth), "mesh growth")),
          counts(kMaxRegions * sizeof(shared::MeshRegionCounts), GL_DYNAMIC_STORAGE_BIT, "mesh counts"),
          places(kMaxRegions * shared::kRangesOfRegion * sizeof(uint), GL_DYNAMIC_STORAGE_BIT, "mesh places"),
          readback(counts.sizeBytes(), "mesh counts read back") {}

    void bind() const;
    void run(const gpu::Program& program) const;

    BlockTable table;
    MeshUpload upload;  // of the batch at hand, as are these
    std::size_t unitCount = 0, regionCount = 0;
    mesh::Method method = mesh::Method::Greedy;
    gpu::Buffer sections, data, units, unitCounts;

    gpu::Program countProgram, writeProgram;
    gpu::Buffer types, growth;   // kept
    gpu::Buffer counts, places;  // by region
    gpu::ReadbackBuffer readback;
    gpu::Fence counted;
    std::array<gpu::Handle<gpu::ObjectKind::Query>, 2> countTimes = {timestampQuery(), timestampQuery()};
};

void GpuMesher::Impl::bind() const {
    sections.bindStorage(shared::kPackedSectionsBinding);
    data.bindStorage(shared::kPackedDataBinding);
    types.bindStorage(shared::kMeshTypesBinding);
    growth.bindStorage(shared::kMeshGrowthBinding);
    units.bindStorage(shared::kMeshUnitsBinding);
    unitCounts.bindStorage(shared::kMeshUnitCountsBinding);
}

void GpuMesher::Impl::run(const gpu::Program& program) const {
    program.use();
    program.set(0, static_cast<GLuint>(method));
    glDispatchCompute(static_cast<GLuint>(unitCount), 1, 1);
}

GpuMesher::GpuMesher(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GpuMesher::GpuMesher(GpuMesher&&) noexcept = default;
GpuMesher& GpuMesher::operator=(GpuMesher&&) noexcept = default;
GpuMesher::~GpuMesher() = default;

base::Result<GpuMesher> GpuMesher::create(const gpu::ShaderLoader& shaders,
                                          const world::BlockRegistry& blocks) {
    auto impl = std::make_unique<Impl>(blocks);
    for (const bool writesQuads : {false, true}) {
        auto made = compile(shaders, writesQuads);
        if (!made) return tl::unexpected(made.error());
        (writesQuads ? impl->writeProgram : impl->countProgram) = std::move(*made);
    }
    return GpuMesher(std::move(impl));
}

void GpuMesher::count(std::span<const mesh::MeshInput> chunks) {
    TERRANE_ZONE("count quads on the GPU");
    assert(!chunks.empty() && chunks.size() <= kMaxChunks && "a batch");
    const mesh::MeshOptions options = chunks.front().options;
    assert(mesh::isRegionHeight(options.regionHeight) && "a power of two, 8 to 128");
    const gpu::DebugGroup group("count quads");
    Impl& m = *impl_;
    m.upload.clear();
    for (const mesh::MeshInput& chunk : chunks) {
        assert(chunk.options == options && "the same for the batch");
        m.upload.add(chunk);
    }
    m.method = options.method;
    m.unitCount = m.upload.units().size();
    m.regionCount = chunks.size() * static_cast<std::size_t>(world::kChunkHeight / options.regionHeight);
    const std::vector<shared::MeshRegionCounts> nothing(m.regionCount, kNothing);
    m.counts.uploadVector(0, nothing);
    glQueryCounter(m.countTimes[0].id(), GL_TIMESTAMP);
    if (m.unitCount > 0) {
        m.sections = bufferOf(std::span(m.upload.packed().sections), "mesh sections");
        m.data = bufferOf(std::span(m.upload.packed().data), "mesh section data");
        m.units = bufferOf(m.upload.units(), "mesh units");
        m.unitCounts =
            gpu::Buffer(m.unitCount * shared::kMeshUnitWords * sizeof(uint), 0, "mesh unit counts");
        m.bind();
        m.counts.bindStorage(shared::kMeshRegionsBinding);
        m.run(m.countProgram);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                        GL_TEXTURE_FETCH_BARRIER_BIT);
    }
    m.upload.clear();
    m.readback.copyFrom(m.counts, m.regionCount * sizeof(shared::MeshRegionCounts));
    glQueryCounter(m.countTimes[1].id(), GL_TIMESTAMP);
    m.counted = gpu::Fence::insert();
}

bool GpuMesher::isCounted() const {
    return impl_->counted.valid() && impl_->counted.passed();
}

double GpuMesher::countMilliseconds() const {
    std::array<GLuint64, 2> nanoseconds{};
    for (std::size_t k = 0; k < 2; ++k) {
        glGetQueryObjectui64v(impl_->countTimes[k].id(), GL_QUERY_RESULT, &nanoseconds[k]);
    }
    return static_cast<double>(nanoseconds[1] - nanoseconds[0]) / 1e6;
}

std::vector<mesh::RegionMesh> GpuMesher::regions() const {
    const Impl& m = *impl_;
    assert(m.counted.valid() && "after count()");
    m.counted.wait();
    std::vector<shared::MeshRegionCounts> counts(m.regionCount);
    std::memcpy(counts.data(), m.readback.data().data(), counts.size() * sizeof(counts[0]));
    std::vector<mesh::RegionMesh> regions(counts.size());
    std::ranges::transform(counts, regions.begin(), regionOf);
    return regions;
}

void GpuMesher::write(std::span<const std::uint32_t> firstQuads, const gpu::Buffer& quads) {
    TERRANE_ZONE("write quads on the GPU");
    Impl& m = *impl_;
    const std::vector<mesh::RegionMesh> counted = regions();
    assert(firstQuads.size() == counted.size() && "a place for each region");
    if (m.unitCount == 0) return;
    const gpu::DebugGroup group("write quads");
    std::vector<uint> places;
    places.reserve(counted.size() * shared::kRangesOfRegion);
    for (std::size_t k = 0; k < counted.size(); ++k) {
        if (firstQuads[k] == kNoPlace) {
            places.insert(places.end(), shared::kRangesOfRegion, kNoPlace);
            continue;
        }
        for (const mesh::QuadRange range : mesh::rangesOf(counted[k])) {
            places.push_back(firstQuads[k] + range.first);
        }
        assert((counted[k].maxZ == 0 ||
                (std::size_t{firstQuads[k]} + mesh::quadCount(counted[k])) * shared::kQuadBytes <=
                    quads.sizeBytes()) &&
               "the quads fit the buffer");
    }
    m.places.uploadVector(0, places);
    m.bind();
    m.places.bindStorage(shared::kMeshRegionsBinding);
    quads.bindStorage(shared::kMeshQuadsBinding);
    m.run(m.writeProgram);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                    GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace terrane::mesh_gpu
