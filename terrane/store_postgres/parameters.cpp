#include "terrane/store_postgres/parameters.h"

#include <utility>

namespace terrane::store_postgres {
namespace {

// Types of parameters (pg_type.dat of PostgreSQL); they never change.
enum : std::uint32_t {
    kBytea = 17,
    kInt8 = 20,
    kInt2 = 21,
    kInt4 = 23,
    kText = 25,
    kByteaArray = 1001,
    kInt2Array = 1005,
    kTextArray = 1009,
    kInt8Array = 1016,
};

// PostgreSQL's binary formats are big-endian.
template <class T>
std::string bigEndian(T value) {
    std::string bytes(sizeof value, '\0');
    for (std::size_t k = 0; k < sizeof value; ++k)
        bytes[k] = static_cast<char>(static_cast<std::uint64_t>(value) >> 8 * (sizeof value - 1 - k));
    return bytes;
}

// Header of a one-dimensional array without NULLs: dimensions, flags, type, then length and lower bound.
std::string arrayHead(std::uint32_t type, std::size_t count) {
    return bigEndian(std::int32_t{1}) + bigEndian(std::int32_t{0}) + bigEndian(type) +
           bigEndian(static_cast<std::int32_t>(count)) + bigEndian(std::int32_t{1});
}

template <class T>
std::string numberArray(std::uint32_t type, std::span<const T> values) {
    std::string bytes = arrayHead(type, values.size());
    for (const T value : values) bytes += bigEndian(std::int32_t{sizeof(T)}) + bigEndian(value);
    return bytes;
}

std::string_view viewOf(ByteView bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Parameters& Parameters::number(std::int64_t value) {
    add(kInt8, bigEndian(value));
    return *this;
}
Parameters& Parameters::integer(std::int32_t value) {
    add(kInt4, bigEndian(value));
    return *this;
}
Parameters& Parameters::text(std::string_view value) {
    add(kText, std::string(value));
    return *this;
}
Parameters& Parameters::bytes(ByteView value) {
    add(kBytea, std::string(viewOf(value)));
    return *this;
}
Parameters& Parameters::numbers(std::span<const std::int64_t> values) {
    add(kInt8Array, numberArray(kInt8, values));
    return *this;
}
Parameters& Parameters::smallNumbers(std::span<const std::int16_t> values) {
    add(kInt2Array, numberArray(kInt2, values));
    return *this;
}
Parameters& Parameters::texts(std::span<const std::string> values) {
    std::string bytes = arrayHead(kText, values.size());
    for (const std::string& value : values)
        bytes += bigEndian(static_cast<std::int32_t>(value.size())) + value;
    add(kTextArray, std::move(bytes));
    return *this;
}
Parameters& Parameters::byteStrings(std::span<const Bytes> values) {
    std::size_t size = 0;
    for (const Bytes& value : values) size += value.size() + 4;
    std::string bytes = arrayHead(kBytea, values.size());
    bytes.reserve(bytes.size() + size);
    for (const Bytes& value : values)
        bytes.append(bigEndian(static_cast<std::int32_t>(value.size()))).append(viewOf(value));
    add(kByteaArray, std::move(bytes));
    return *this;
}
void Parameters::add(std::uint32_t type, std::string bytes) {
    types_.push_back(type);
    values_.push_back(std::move(bytes));
}

}  // namespace terrane::store_postgres
