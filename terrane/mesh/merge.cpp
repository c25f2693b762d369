#include "terrane/mesh/merge.h"

#include <bit>
#include <cassert>

namespace terrane::mesh {
namespace {

Rectangle rectangle(int bit, unsigned row, int bits, unsigned rows) {
    return {static_cast<std::uint8_t>(bit), static_cast<std::uint8_t>(row), static_cast<std::uint8_t>(bits),
            static_cast<std::uint8_t>(rows)};
}

std::span<const Rectangle> mergeGreedy(const PlaneRows& plane, RectangleBuffer& buffer) {
    std::size_t count = 0;
    for (unsigned row = plane.first; row < plane.end; ++row) {
        for (unsigned left = plane.rows[row * plane.step]; left != 0;) {
            // Adding the lowest one carries through the ones above it: what the carry clears is the run.
            const unsigned lowest = left & (0u - left);
            const unsigned carried = left + lowest;
            const unsigned run = left & ~carried;
            left ^= run;
            unsigned end = row + 1;
            for (; end < plane.end && (plane.rows[end * plane.step] & run) == run; ++end) {
                plane.rows[end * plane.step] ^= static_cast<std::uint16_t>(run);
            }
            const int bit = std::countr_zero(lowest);
            buffer[count++] = rectangle(bit, row, std::countr_zero(carried) - bit, end - row);
        }
    }
    return {buffer.data(), count};
}

std::span<const Rectangle> mergeNothing(const PlaneRows& plane, RectangleBuffer& buffer) {
    std::size_t count = 0;
    for (unsigned row = plane.first; row < plane.end; ++row) {
        for (unsigned left = plane.rows[row * plane.step]; left != 0; left &= left - 1) {
            buffer[count++] = rectangle(std::countr_zero(left), row, 1, 1);
        }
    }
    return {buffer.data(), count};
}

// The methods of the thesis start from one rectangle a bit and join neighbours, step by step.
enum Axis : std::uint8_t { kAlongRow, kAcrossRows };

// Joins along an axis rectangles that touch at a line and are equally long beside it.
struct JoinStep {
    Axis axis;
    std::uint16_t lines;  // where: bit n stands for the line between bits (or rows) n − 1 and n
    unsigned length = 0;  // of both rectangles along the axis; 0: any
};

// Sizes of the rectangles by the cell of their lowest corner, bit + 16 row; 0 where none begins.
using Sizes = std::array<std::array<std::uint8_t, 256>, 2>;

void join(Sizes& sizes, JoinStep step) {
    auto& along = sizes[step.axis];
    auto& across = sizes[1 - step.axis];
    const unsigned stride = step.axis == kAlongRow ? 1 : 16;
    for (unsigned cell = 0; cell < 256; ++cell) {
        if (along[cell] == 0) continue;
        const unsigned first = cell / stride % 16;
        for (;;) {
            const unsigned end = first + along[cell], next = cell + along[cell] * stride;
            if (end == 16 || (step.lines >> end & 1) == 0 || across[next] != across[cell]) break;
            if (step.length != 0 && (along[cell] != step.length || along[next] != step.length)) break;
            along[cell] = static_cast<std::uint8_t>(along[cell] + along[next]);
            along[next] = across[next] = 0;
        }
    }
}

template <class Steps>
std::span<const Rectangle> mergeInSteps(const PlaneRows& plane, const Steps& steps, RectangleBuffer& buffer) {
    Sizes sizes{};
    for (unsigned cell = 16 * plane.first; cell < 16 * plane.end; ++cell) {
        sizes[kAlongRow][cell] = sizes[kAcrossRows][cell] =
            static_cast<std::uint8_t>(plane.rows[cell / 16 * plane.step] >> cell % 16 & 1);
    }
    for (const JoinStep step : steps) join(sizes, step);
    std::size_t count = 0;
    for (unsigned cell = 0; cell < 256; ++cell) {
        const int bits = sizes[kAlongRow][cell];
        if (bits == 0) continue;
        buffer[count++] = rectangle(static_cast<int>(cell % 16), cell / 16, bits, sizes[kAcrossRows][cell]);
    }
    return {buffer.data(), count};
}

constexpr std::uint16_t kInsideCells = 0xFEFE;  // all lines but those between cells of 8
constexpr std::uint16_t kGrid2 = 0xAAAA, kGrid4 = 0x4444, kGrid8 = 0x1010;  // middles of cells of 2, 4, 8

constexpr std::array<JoinStep, 2> kLines{{{kAlongRow, kInsideCells}, {kAcrossRows, kInsideCells}}};
constexpr std::array<JoinStep, 6> kSquares{{{kAlongRow, kGrid2, 1},
                                            {kAcrossRows, kGrid2, 1},
                                            {kAlongRow, kGrid4, 2},
                                            {kAcrossRows, kGrid4, 2},
                                            {kAlongRow, kGrid8, 4},
                                            {kAcrossRows, kGrid8, 4}}};
constexpr std::array<JoinStep, 8> kSquaresExt{
    {kSquares[0], kSquares[1], kSquares[2], kSquares[3], kSquares[4], kSquares[5], kLines[0], kLines[1]}};

template <const auto& kSteps>
std::span<const Rectangle> mergeBy(const PlaneRows& plane, RectangleBuffer& buffer) {
    return mergeInSteps(plane, kSteps, buffer);
}

constexpr std::array<MergeFunction, static_cast<std::size_t>(Method::Count)> kFunctions{
    mergeNothing, mergeBy<kLines>, mergeBy<kSquares>, mergeBy<kSquaresExt>, mergeGreedy};

}  // namespace

MergeFunction mergeFunction(Method method) {
    assert(method < Method::Count && "one of the methods");
    return kFunctions[static_cast<std::size_t>(method)];
}

}  // namespace terrane::mesh
