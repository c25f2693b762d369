#include "terrane/base/npy.h"

#include <fmt/format.h>

#include <cassert>
#include <string_view>

namespace terrane::base {

namespace {

constexpr std::string_view kMagic("\x93NUMPY\x01\x00", 8);  // with the version, 1.0
constexpr std::size_t kLengthBytes = 2;
constexpr std::size_t kAlignment = 64;  // the data starts on a multiple, so that the file can be mapped
constexpr std::size_t kMaxHeaderBytes = 65535;

// A Python tuple: "()", "(5,)" (the comma makes it one), "(2, 3)".
std::string shapeText(const std::vector<std::size_t>& shape) {
    if (shape.size() == 1) return fmt::format("({},)", shape[0]);
    return fmt::format("({})", fmt::join(shape, ", "));
}

[[maybe_unused]] bool fitsShape(const NpyArray& array) {
    std::size_t elementCount = 1;
    for (const std::size_t extent : array.shape) elementCount *= extent;
    return elementCount == 0 ? array.data.empty() : array.data.size() % elementCount == 0;
}

}  // namespace

std::string encodeNpy(const NpyArray& array) {
    assert(!array.descr.empty() && "an array has an element type");
    assert(fitsShape(array) && "the data is a whole number of bytes for each element");
    const std::string descr = array.descr.front() == '[' ? array.descr : fmt::format("'{}'", array.descr);
    std::string header =
        fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': {}, }}", descr, shapeText(array.shape));
    const std::size_t usedBytes = kMagic.size() + kLengthBytes + header.size() + 1;
    header.append((kAlignment - usedBytes % kAlignment) % kAlignment, ' ');
    header += '\n';
    assert(header.size() <= kMaxHeaderBytes && "version 1.0 counts the header in 16 bits");
    std::string bytes(kMagic);
    bytes += static_cast<char>(header.size() & 255);
    bytes += static_cast<char>(header.size() >> 8);
    return bytes + header + array.data;
}

}  // namespace terrane::base
