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

constexpr std::size_t kFirstMeshSections = 8192;
constexpr shared::MeshSectionCounts kNothing{{}, shared::kQuadSlab, 0};
constexpr std::size_t kMaxUnitsPerRow = 32768;  // OpenGL has 65,535 work groups along an axis at least

base::Result<gpu::Program> compile(const gpu::ShaderLoader& shaders, bool writesQuads) {
    return gpu::Program::compute(shaders, "terrane/mesh_gpu/mesh.comp.glsl",
                                 {{"WRITES_QUADS", writesQuads ? "1" : "0"}},
                                 writesQuads ? "mesh write" : "mesh count");
}

template <class T>
gpu::Buffer bufferOf(std::span<const T> values, std::string_view label) {
    return gpu::Buffer(std::as_bytes(values), 0, label);
}

// Sets the ranges and bounds. Counts are in the order of mesh::rangesOf().
mesh::MeshSection withCounts(mesh::MeshSection meshSection, const shared::MeshSectionCounts& counts) {
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
        meshSection.minZ = mesh::quadBase(meshSection) + static_cast<int>(counts.minZ);
        meshSection.maxZ = mesh::quadBase(meshSection) + static_cast<int>(counts.maxZ);
    }
    return meshSection;
}

}  // namespace

struct GpuMesher::Impl {
    explicit Impl(const world::BlockRegistry& blocks)
        : table(blocks),
          upload(table),
          types(bufferOf(std::span<const shared::MeshType>(table.types), "mesh types")),
          forms(bufferOf(std::span<const uint>(table.forms), "mesh forms")) {
        reserve(kFirstMeshSections);
    }

    void reserve(std::size_t meshSectionCount);
    void bind() const;
    void run(const gpu::Program& program) const;

    BlockTable table;
    MeshUpload upload;  // of the current batch, as are these
    std::size_t unitCount = 0;
    std::vector<mesh::MeshSection> meshSections;  // without quads
    std::vector<std::size_t> chunkEnds;
    mesh::MergeMethod method = mesh::MergeMethod::Greedy;
    gpu::Buffer sections, data, units, unitCounts;

    gpu::Program countProgram, writeProgram;
    gpu::Buffer types, forms;  // kept
    // By mesh section; they grow to the largest batch.
    gpu::Buffer counts, places;
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
    const std::size_t row = std::min(unitCount, kMaxUnitsPerRow);
    glDispatchCompute(static_cast<GLuint>(row), static_cast<GLuint>((unitCount + row - 1) / row), 1);
}

// Counts that are not read yet are lost.
void GpuMesher::Impl::reserve(std::size_t meshSectionCount) {
    const std::size_t bytes = meshSectionCount * sizeof(shared::MeshSectionCounts);
    if (counts.sizeBytes() >= bytes) return;
    counts = gpu::Buffer(bytes, GL_DYNAMIC_STORAGE_BIT, "mesh counts");
    places = gpu::Buffer(meshSectionCount * shared::kRangesPerMeshSection * sizeof(uint),
                         GL_DYNAMIC_STORAGE_BIT, "mesh places");
    readback = gpu::ReadbackBuffer(bytes, "mesh counts read back");
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
    m.meshSections.assign(m.upload.meshSections().begin(), m.upload.meshSections().end());
    m.chunkEnds.assign(m.upload.chunkEnds().begin(), m.upload.chunkEnds().end());
    m.reserve(m.meshSections.size());
    const std::vector<shared::MeshSectionCounts> nothing(m.meshSections.size(), kNothing);
    if (!nothing.empty()) m.counts.uploadVector(0, nothing);
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
    if (!nothing.empty()) m.readback.copyFrom(m.counts, nothing.size() * sizeof(nothing[0]));
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

CountedSections GpuMesher::meshSections() const {
    const Impl& m = *impl_;
    base::require(m.counted.valid(), "GpuMesher::meshSections: count() comes first");
    m.counted.wait();
    std::vector<shared::MeshSectionCounts> counts(m.meshSections.size());
    if (!counts.empty())
        std::memcpy(counts.data(), m.readback.data().data(), counts.size() * sizeof(counts[0]));
    CountedSections counted;
    std::size_t next = 0;
    for (const std::size_t end : m.chunkEnds) {
        for (; next < end; ++next)
            if (counts[next].maxZ > 0) counted.all.push_back(withCounts(m.meshSections[next], counts[next]));
        counted.chunkEnds.push_back(counted.all.size());
    }
    return counted;
}

void GpuMesher::write(std::span<const std::uint32_t> firstQuads, const gpu::Buffer& quads) {
    TERRANE_ZONE("write quads on the GPU");
    Impl& m = *impl_;
    const CountedSections counted = meshSections();
    base::require(firstQuads.size() == counted.all.size(),
                  "GpuMesher::write: each mesh section needs a place");
    if (m.unitCount == 0) return;
    const gpu::DebugGroup group("write quads");
    // Of all mesh sections of the batch: those without quads have no place.
    std::vector<uint> places(m.meshSections.size() * shared::kRangesPerMeshSection, kNoPlace);
    std::size_t number = 0, next = 0;
    for (std::size_t chunk = 0; chunk < m.chunkEnds.size(); ++chunk) {
        for (const mesh::MeshSection& meshSection : counted.ofChunk(chunk)) {
            while (m.meshSections[number].bottom != meshSection.bottom) ++number;
            const uint first = firstQuads[next++];
            if (first == kNoPlace) continue;
            const std::size_t end = std::size_t{first} + mesh::quadCount(meshSection);
            base::require(end * shared::kQuadBytes <= quads.sizeBytes(),
                          "GpuMesher::write: the quads of a mesh section do not fit the buffer");
            uint* place = &places[number * shared::kRangesPerMeshSection];
            for (const mesh::QuadRange range : mesh::rangesOf(meshSection)) *place++ = first + range.first;
        }
        number = m.chunkEnds[chunk];
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
    const CountedSections counted = mesher_.meshSections();
    std::vector<std::uint32_t> firstQuads;
    std::uint32_t total = 0;
    for (const mesh::MeshSection& meshSection : counted.all) {
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
    auto from = quads.begin();
    for (std::size_t k = 0; k < chunks.size(); ++k) {
        mesh::ChunkMesh& chunk = meshes.emplace_back();
        std::uint32_t first = 0;
        for (const mesh::MeshSection& meshSection : counted.ofChunk(k)) {
            chunk.meshSections.push_back(mesh::movedTo(first, meshSection));
            first += mesh::quadCount(meshSection);
        }
        chunk.quads.assign(from, from + first);
        from += first;
    }
}

}  // namespace terrane::mesh_gpu
