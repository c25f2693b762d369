// NumPy arrays that own memory of the library, and areas from Python sequences.
#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "terrane/volume/block_area.h"

namespace terrane::python {

// Zeroed memory that the capsule frees. Large memory uses huge pages if the system has them: a chunk of a
// wide area touches 2,048 pages of 4 KiB, since the rows of a layer are far apart.
struct ZeroedMemory {
    void* bytes;
    pybind11::capsule owner;
};
ZeroedMemory zeroedMemory(std::size_t bytes);

// An array of zeros.
template <class T>
pybind11::array_t<T> zeros(const std::vector<pybind11::ssize_t>& shape) {
    std::size_t count = 1;
    for (const pybind11::ssize_t side : shape) count *= static_cast<std::size_t>(side);
    const ZeroedMemory memory = zeroedMemory(std::max<std::size_t>(count, 1) * sizeof(T));
    return pybind11::array_t<T>(shape, static_cast<T*>(memory.bytes), memory.owner);
}

// An element of a sequence as integer. BadInput, with the text `what`, for anything else.
std::int64_t integerFrom(const pybind11::handle& number, const char* what);

// (x0, y0, x1, y1) has the world's full height, (x0, y0, z0, x1, y1, z1) is a box; checked.
volume::BlockArea areaFrom(const pybind11::sequence& numbers);

// Reads (x0, y0, x1, y1). `what` is for messages.
std::array<std::int64_t, 4> fourNumbers(const pybind11::sequence& numbers, const char* what);

}  // namespace terrane::python
