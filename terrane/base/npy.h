// Arrays as NumPy files (.npy, format version 1.0), for looking at worlds and fields outside the program.
// Pure functions: any thread may call.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace terrane::base {

struct NpyArray {
    std::string descr;  // as NumPy writes it: "<u2", or for records "[('x', '|u1'), ('id', '<u2')]"
    std::vector<std::size_t> shape;  // outermost first; empty for a single value
    std::string data;                // the elements, last index fastest, in the byte order that descr says
};

// Returns the header before the elements, a multiple of 64 bytes. `minBytes` reserves room, so that a header
// can be replaced once the shape is known.
[[nodiscard]] std::string npyHeader(const std::string& descr, const std::vector<std::size_t>& shape,
                                    std::size_t minBytes = 0);

// Returns the bytes of the whole file.
[[nodiscard]] std::string encodeNpy(const NpyArray& array);

}  // namespace terrane::base
