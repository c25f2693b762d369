#include "terrane/mesh_gpu/gpu_mesher.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "terrane/base/profile.h"
#include "terrane/base/result.h"
#include "terrane/gpu/debug.h"
#include "terrane/gpu/program.h"
#include "terrane/gpu/readback_buffer.h"
#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/mesh_gpu/block_table.h"
#include "terrane/mesh_gpu/mesh_upload_internal.h"

namespace terrane::mesh_gpu {

namespace {

using shared::uint;

constexpr std::size_t kMaxMeshSections =
    GpuMesher::kMaxChunks * (world::kChunkHeight / mesh::kMinMeshSectionHeight);
constexpr shared::MeshSectionCounts kNothing{{}, world::kChunkHeight, 0};
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

// Counts are in the order of mesh::rangesOf().
mesh::MeshSection meshSectionOf(const shared::MeshSectionCounts& counts) {
    mesh::MeshSection meshSection;
    uint first = 0;
    std::size_t next = 0;
    for (int bucket = 0; bucket < mesh::kDrawBucketCount; ++bucket) {
        for (int direction = 0; direction < mesh::kFaceDirectionCount; ++direction) {
            const bool hasRange = !mesh::bucketTwoSided(bucket) || direction == mesh::kAnyDirection;
            const uint count = hasRange ? counts.quads[next++] : 0;
            meshSection.ranges[bucket][direction] = {first, count};
            first += count;
        }
    }
    if (counts.minZ < counts.maxZ) {
        meshSection.minZ = static_cast<int>(counts.minZ);
        meshSection.maxZ = static_cast<int>(counts.maxZ);
    }
    return meshSection;
}

}  // namespace

struct GpuMesher::Impl {
    explicit Impl(const world::BlockRegistry& blocks)
        : table(blocks),
          upload(table),
          types(bufferOf(std::span<const shared::MeshType>(table.types), "mesh types")),
          forms(bufferOf(std::span<const uint>(table.forms), "mesh forms")),
          counts(kMaxMeshSections * sizeof(shared::MeshSectionCounts), GL_DYNAMIC_STORAGE_BIT, "mesh counts"),
          places(kMaxMeshSections * shared::kRangesPerMeshSection * sizeof(uint), GL_DYNAMIC_STORAGE_BIT,
                 "mesh places"),
          readback(counts.sizeBytes(), "mesh counts read back") {}

    void bind() const;
    void run(const gpu::Program& program) const;

    BlockTable table;
    MeshUpload upload;  // of the current batch, as are these
    std::size_t unitCount = 0, meshSectionCount = 0;
    mesh::MergeMethod method = mesh::MergeMethod::Greedy;
    gpu::Buffer sections, data, units, unitCounts;

    gpu::Program countProgram, writeProgram;
    gpu::Buffer types, forms;    // kept
    gpu::Buffer counts, places;  // by mesh section
    gpu::ReadbackBuffer readback;
    gpu::Fence counted;
    std::array<gpu::Handle<gpu::ObjectKind::Query>, 2> countTimes = {gpu::createQuery(GL_TIMESTAMP),
                                                                     gpu::createQuery(GL_TIMESTAMP)};
};

void GpuMesher::Impl::bind() const {
    sections.bindStorage(shared::kPackedSectionsBinding);
    data.bindStorage(shared::kPackedDataBinding);
    types.bindStorage(shared::kMeshTypesBinding);
    forms.bindStorage(shared::kMeshFormsBinding);
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
        auto made = TERRANE_TRY(compile(shaders, writesQuads));
        (writesQuads ? impl->writeProgram : impl->countProgram) = std::move(made);
    }
    return GpuMesher(std::move(impl));
}

void GpuMesher::count(std::span<const mesh::MeshInput> chunks) {
    TERRANE_ZONE("count quads on the GPU");
    base::require(!chunks.empty() && chunks.size() <= kMaxChunks,
                  "GpuMesher::count: a batch has 1 to 256 chunks");
    const mesh::MeshOptions options = chunks.front().options;
    base::require(mesh::isMeshSectionHeight(options.meshSectionHeight),
                  "GpuMesher::count: the height of mesh sections is a power of two, 8 to 128");
    const gpu::DebugGroup group("count quads");
    Impl& m = *impl_;
    m.upload.clear();
    for (const mesh::MeshInput& chunk : chunks) {
        base::require(chunk.options == options,
                      "GpuMesher::count: the chunks of a batch have the same options");
        m.upload.add(chunk);
    }
    m.method = options.method;
    m.unitCount = m.upload.units().size();
    m.meshSectionCount =
        chunks.size() * static_cast<std::size_t>(world::kChunkHeight / options.meshSectionHeight);
    const std::vector<shared::MeshSectionCounts> nothing(m.meshSectionCount, kNothing);
    m.counts.uploadVector(0, nothing);
    glQueryCounter(m.countTimes[0].id(), GL_TIMESTAMP);
    if (m.unitCount > 0) {
        m.sections = bufferOf(std::span(m.upload.packed().sections), "mesh sections");
        m.data = bufferOf(std::span(m.upload.packed().data), "mesh section data");
        m.units = bufferOf(m.upload.units(), "mesh units");
        m.unitCounts =
            gpu::Buffer(m.unitCount * shared::kMeshUnitWords * sizeof(uint), 0, "mesh unit counts");
        m.bind();
        m.counts.bindStorage(shared::kMeshSectionCountsBinding);
        m.run(m.countProgram);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                        GL_TEXTURE_FETCH_BARRIER_BIT);
    }
    m.upload.clear();
    m.readback.copyFrom(m.counts, m.meshSectionCount * sizeof(shared::MeshSectionCounts));
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

std::size_t GpuMesher::gpuBytes() const {
    const Impl& m = *impl_;
    std::size_t bytes = m.counts.sizeBytes();  // the readback buffer has the same size
    for (const gpu::Buffer* buffer :
         {&m.sections, &m.data, &m.units, &m.unitCounts, &m.types, &m.forms, &m.counts, &m.places})
        bytes += buffer->sizeBytes();
    return bytes;
}

std::vector<mesh::MeshSection> GpuMesher::meshSections() const {
    const Impl& m = *impl_;
    base::require(m.counted.valid(), "GpuMesher::meshSections: count() comes first");
    m.counted.wait();
    std::vector<shared::MeshSectionCounts> counts(m.meshSectionCount);
    std::memcpy(counts.data(), m.readback.data().data(), counts.size() * sizeof(counts[0]));
    std::vector<mesh::MeshSection> meshSections(counts.size());
    std::ranges::transform(counts, meshSections.begin(), meshSectionOf);
    return meshSections;
}

void GpuMesher::write(std::span<const std::uint32_t> firstQuads, const gpu::Buffer& quads) {
    TERRANE_ZONE("write quads on the GPU");
    Impl& m = *impl_;
    const std::vector<mesh::MeshSection> counted = meshSections();
    base::require(firstQuads.size() == counted.size(), "GpuMesher::write: each mesh section needs a place");
    if (m.unitCount == 0) return;
    const gpu::DebugGroup group("write quads");
    std::vector<uint> places;
    places.reserve(counted.size() * shared::kRangesPerMeshSection);
    for (std::size_t k = 0; k < counted.size(); ++k) {
        if (firstQuads[k] == kNoPlace) {
            places.insert(places.end(), shared::kRangesPerMeshSection, kNoPlace);
            continue;
        }
        for (const mesh::QuadRange range : mesh::rangesOf(counted[k])) {
            places.push_back(firstQuads[k] + range.first);
        }
        const std::size_t end = std::size_t{firstQuads[k]} + mesh::quadCount(counted[k]);
        base::require(counted[k].maxZ == 0 || end * shared::kQuadBytes <= quads.sizeBytes(),
                      "GpuMesher::write: the quads of a mesh section do not fit the buffer");
    }
    m.places.uploadVector(0, places);
    m.bind();
    m.places.bindStorage(shared::kMeshSectionCountsBinding);
    quads.bindStorage(shared::kMeshQuadsBinding);
    m.run(m.writeProgram);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                    GL_TEXTURE_FETCH_BARRIER_BIT);
}

std::vector<mesh::ChunkMesh> GpuBatchMesher::mesh(std::span<const mesh::MeshInput> chunks) {
    std::vector<mesh::ChunkMesh> meshes;
    meshes.reserve(chunks.size());
    while (!chunks.empty()) {
        const std::size_t count = std::min(chunks.size(), GpuMesher::kMaxChunks);
        meshPart(chunks.first(count), meshes);
        chunks = chunks.subspan(count);
    }
    return meshes;
}

void GpuBatchMesher::meshPart(std::span<const mesh::MeshInput> chunks, std::vector<mesh::ChunkMesh>& meshes) {
    mesher_.count(chunks);
    const std::vector<mesh::MeshSection> meshSections = mesher_.meshSections();
    std::vector<std::uint32_t> firstQuads;
    std::uint32_t total = 0;
    for (const mesh::MeshSection& meshSection : meshSections) {
        firstQuads.push_back(total);
        total += mesh::quadCount(meshSection);
    }
    std::vector<shared::Quad> quads(total);
    if (total > 0) {
        const std::size_t bytes = std::size_t{total} * shared::kQuadBytes;
        if (quads_.sizeBytes() < bytes) quads_ = gpu::Buffer(bytes, 0, "mesh result");
        mesher_.write(firstQuads, quads_);
        quads_.download(0, std::as_writable_bytes(std::span(quads)));
    }
    const std::size_t meshSectionsPerChunk = meshSections.size() / chunks.size();
    auto from = quads.begin();
    for (std::size_t k = 0; k < meshSections.size(); k += meshSectionsPerChunk) {
        mesh::ChunkMesh& chunk = meshes.emplace_back();
        std::uint32_t first = 0;
        for (std::size_t r = k; r < k + meshSectionsPerChunk; ++r) {
            chunk.meshSections.push_back(mesh::movedTo(first, meshSections[r]));
            first += mesh::quadCount(meshSections[r]);
        }
        chunk.quads.assign(from, from + first);
        from += first;
    }
}

}  // namespace terrane::mesh_gpu
