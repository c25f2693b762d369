// NumPy arrays that own memory of the library.
#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

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

template <class T>
std::span<T> valuesOf(pybind11::array_t<T>& array) {
    return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

}  // namespace terrane::python
