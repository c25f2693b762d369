#include "terrane/base/npy.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "terrane/base/result.h"

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

std::string npyHeader(const std::string& descr, const std::vector<std::size_t>& shape, std::size_t minBytes) {
    require(!descr.empty(), "npyHeader: an array has an element type");
    const std::string type = descr.front() == '[' ? descr : fmt::format("'{}'", descr);
    std::string header =
        fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': {}, }}", type, shapeText(shape));
    const std::size_t usedBytes = kMagic.size() + kLengthBytes + header.size() + 1;
    const std::size_t wholeBytes = (std::max(usedBytes, minBytes) + kAlignment - 1) / kAlignment * kAlignment;
    header.append(wholeBytes - usedBytes, ' ');
    header += '\n';
    require(header.size() <= kMaxHeaderBytes,
            "npyHeader: version 1.0 has no header of more than 65,535 bytes");
    std::string bytes(kMagic);
    bytes += static_cast<char>(header.size() & 255);
    bytes += static_cast<char>(header.size() >> 8);
    return bytes + header;
}

std::string encodeNpy(const NpyArray& array) {
    require(fitsShape(array), "encodeNpy: the data is a whole number of bytes for each element");
    return npyHeader(array.descr, array.shape) + array.data;
}

}  // namespace terrane::base
