#include "python/src/arrays.h"

#include <sys/mman.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

#include "python/src/errors.h"

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

std::int64_t integerFrom(const py::handle& number, const char* what) {
    try {
        return number.cast<std::int64_t>();
    } catch (const py::cast_error&) {
        throw Failure({base::ErrorCode::BadInput, fmt::format("{}: expected an integer, got {}", what,
                                                              py::repr(number).cast<std::string>())});
    }
}

std::array<std::int64_t, 4> fourNumbers(const py::sequence& numbers, const char* what) {
    if (py::len(numbers) != 4)
        throw Failure({base::ErrorCode::BadInput,
                       fmt::format("{}: expected (x0, y0, x1, y1), got {} numbers", what, py::len(numbers))});
    std::array<std::int64_t, 4> values{};
    for (std::size_t k = 0; k < 4; ++k) values[k] = integerFrom(numbers[k], what);
    return values;
}

volume::BlockArea areaFrom(const py::sequence& numbers) {
    const std::size_t count = py::len(numbers);
    if (count != 4 && count != 6)
        throw Failure(
            {base::ErrorCode::BadInput,
             fmt::format("area: expected (x0, y0, x1, y1) or (x0, y0, z0, x1, y1, z1), got {} numbers",
                         count)});
    const auto at = [&](std::size_t k) { return integerFrom(numbers[k], "area"); };
    const volume::BlockArea area = count == 4
                                       ? volume::BlockArea{at(0), at(1), 0, at(2), at(3), world::kChunkHeight}
                                       : volume::BlockArea{at(0), at(1), at(2), at(3), at(4), at(5)};
    valueOr(volume::checkArea(area));
    return area;
}

}  // namespace terrane::python
