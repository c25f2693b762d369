// The columns of a tile whose lower layers are requested, while 3D passes run from the top down. All at
// first; callers drop columns.
#pragma once

#include <array>

#include "terrane/gen/program.h"

namespace terrane::gen {

class WantedColumns {
  public:
    WantedColumns() {
        lanes_.fill(~Bits{0});
        left_.fill(kRowLanes);
    }

    bool has(std::size_t column) const { return lanes_[column] != 0; }  // x + 16 y
    void drop(std::size_t column) {
        if (!has(column)) return;
        lanes_[column] = 0;
        const std::size_t row = column / kRowLanes;
        if (--left_[row] == 0) rows_ = static_cast<RowMask>(rows_ & ~(1u << row));
    }

    RowMask rows() const { return rows_; }               // those with wanted columns
    const Bits* lanes() const { return lanes_.data(); }  // all bits of a column, or none; aligned for SIMD

  private:
    alignas(64) std::array<Bits, kTileLanes> lanes_;
    std::array<std::uint8_t, kTileSize> left_;  // wanted columns, by row
    RowMask rows_ = kAllRows;
};

}  // namespace terrane::gen
