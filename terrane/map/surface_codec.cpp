#include "terrane/map/surface_codec.h"

#include <algorithm>
#include <string_view>

#include "terrane/base/digest.h"
#include "terrane/store/compression.h"

namespace terrane::map {
namespace {

// A column is four numbers in six planes of bytes, one plane after the other, which zstd makes small: the
// height as the difference to a prediction from its neighbors, the depth beneath it, the top block's id in
// two bytes, and the difference of the lower block's id in two more, which is 0 nearly everywhere on land.
enum Plane { HeightPlane, DepthPlane, TopLow, TopHigh, UnderLow, UnderHigh, kPlanes };
constexpr std::size_t kPlaneBytes = kColumnsOfBlob, kRawBytes = kPlanes * kPlaneBytes;

// The prediction from earlier columns: in a plane each height is west + south - southwest.
template <class HeightAt>
std::uint8_t predictedHeight(std::size_t k, HeightAt heightAt) {
    const bool hasWest = k % kBlobColumns != 0, hasSouth = k >= kBlobColumns;
    if (hasWest && hasSouth)
        return static_cast<std::uint8_t>(std::clamp(
            heightAt(k - 1) + heightAt(k - kBlobColumns) - heightAt(k - kBlobColumns - 1), 0, 255));
    if (hasWest) return static_cast<std::uint8_t>(heightAt(k - 1));
    return hasSouth ? static_cast<std::uint8_t>(heightAt(k - kBlobColumns)) : 0;
}

std::uint64_t checksum(store::ByteView bytes) {
    return base::hash64({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::uint8_t low(unsigned value) {
    return static_cast<std::uint8_t>(value & 0xFF);
}
std::uint8_t high(unsigned value) {
    return static_cast<std::uint8_t>(value >> 8 & 0xFF);
}

}  // namespace

store::Bytes encodeSurfaces(std::span<const SurfaceColumn> columns) {
    std::vector<std::uint8_t> raw(kRawBytes);
    const auto plane = [&](Plane p, std::size_t k) -> std::uint8_t& { return raw[p * kPlaneBytes + k]; };
    for (std::size_t k = 0; k < kColumnsOfBlob; ++k) {
        const SurfaceColumn& column = columns[k];
        const auto height = [&](std::size_t n) { return static_cast<int>(columns[n].topZ); };
        const auto underChange = static_cast<unsigned>(column.under) - column.top;
        plane(HeightPlane, k) = low(static_cast<unsigned>(column.topZ) - predictedHeight(k, height));
        plane(DepthPlane, k) = low(static_cast<unsigned>(column.topZ) - column.underZ);
        plane(TopLow, k) = low(column.top);
        plane(TopHigh, k) = high(column.top);
        plane(UnderLow, k) = low(underChange);
        plane(UnderHigh, k) = high(underChange);
    }
    store::Bytes bytes;
    store::appendNumber(bytes, checksum(std::as_bytes(std::span(raw))));
    store::appendCompressed(bytes, std::as_bytes(std::span(raw)));
    return bytes;
}

base::Result<std::vector<SurfaceColumn>> decodeSurfaces(store::ByteView bytes) {
    store::ByteReader reader(bytes);
    const auto expected = reader.number<std::uint64_t>();
    std::vector<std::uint8_t> raw(kRawBytes);
    TERRANE_TRY(store::decompress(reader.rest(), std::as_writable_bytes(std::span(raw))));
    if (checksum(std::as_bytes(std::span(raw))) != expected)
        return base::fail(base::ErrorCode::Damaged, "surfaces: wrong checksum");
    std::vector<SurfaceColumn> columns(kColumnsOfBlob);
    const auto plane = [&](Plane p, std::size_t k) { return unsigned{raw[p * kPlaneBytes + k]}; };
    for (std::size_t k = 0; k < kColumnsOfBlob; ++k) {
        const auto height = [&](std::size_t n) { return static_cast<int>(columns[n].topZ); };
        SurfaceColumn& column = columns[k];
        column.topZ = low(plane(HeightPlane, k) + predictedHeight(k, height));
        column.underZ = low(column.topZ - plane(DepthPlane, k));
        column.top = static_cast<world::BlockId>(plane(TopLow, k) | plane(TopHigh, k) << 8);
        column.under =
            static_cast<world::BlockId>(column.top + (plane(UnderLow, k) | plane(UnderHigh, k) << 8));
    }
    return columns;
}

}  // namespace terrane::map
