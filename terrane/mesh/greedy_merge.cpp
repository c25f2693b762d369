#include "terrane/mesh/greedy_merge.h"

#include <bit>

namespace terrane::mesh {
namespace {

std::uint32_t usedRows(const BitSlice& rows) {
    std::uint32_t used = 0;
    for (std::size_t row = 0; row < rows.size(); ++row) used |= std::uint32_t{rows[row] != 0} << row;
    return used;
}

}  // namespace

std::span<const Rectangle> mergeRows(BitSlice rows, Merge merge, RectangleBuffer& buffer) {
    std::size_t count = 0;
    for (std::uint32_t used = usedRows(rows); used != 0; used &= used - 1) {
        const auto row = static_cast<std::size_t>(std::countr_zero(used));
        unsigned left = rows[row];
        while (left != 0) {
            // Adding the lowest one carries through the ones above it: what the carry clears is the run.
            const unsigned lowest = left & (0u - left);
            const unsigned carried = merge == Merge::None ? lowest << 1 : left + lowest;
            const unsigned run = merge == Merge::None ? lowest : left & ~carried;
            left ^= run;
            std::size_t end = row + 1;
            if (merge == Merge::Full) {
                for (; end < rows.size() && (rows[end] & run) == run; ++end) {
                    rows[end] = static_cast<std::uint16_t>(rows[end] ^ run);
                }
            }
            const int bit = std::countr_zero(lowest);
            buffer[count++] = {static_cast<std::uint8_t>(bit), static_cast<std::uint8_t>(row),
                               static_cast<std::uint8_t>(std::countr_zero(carried) - bit),
                               static_cast<std::uint8_t>(end - row)};
        }
    }
    return {buffer.data(), count};
}

}  // namespace terrane::mesh
