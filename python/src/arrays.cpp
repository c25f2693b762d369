#include "python/src/arrays.h"

#include <sys/mman.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

namespace py = pybind11;

namespace terrane::python {
namespace {

constexpr std::size_t kLargeBytes = std::size_t{4} << 20;

struct Mapping {
    void* bytes;
    std::size_t size;
};

ZeroedMemory mappedMemory(std::size_t bytes) {
    void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    (void)madvise(memory, bytes, MADV_HUGEPAGE);  // optional: only affects speed
    auto mapping = std::make_unique<Mapping>(Mapping{memory, bytes});
    py::capsule owner(mapping.get(), [](void* given) {
        const std::unique_ptr<Mapping> owned(static_cast<Mapping*>(given));
        munmap(owned->bytes, owned->size);
    });
    mapping.release();
    return {memory, std::move(owner)};
}

}  // namespace

ZeroedMemory zeroedMemory(std::size_t bytes) {
    if (bytes >= kLargeBytes) return mappedMemory(bytes);
    void* memory = std::calloc(bytes, 1);
    if (memory == nullptr) throw std::bad_alloc();
    return {memory, py::capsule(memory, [](void* given) { std::free(given); })};
}

}  // namespace terrane::python
