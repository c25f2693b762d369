// Parameters of statements in PostgreSQL's binary formats. Plain values; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/store/bytes.h"

namespace terrane::store_postgres {

using store::Bytes;
using store::ByteView;

// Values of $1, $2, … in binary format.
class Parameters {
  public:
    Parameters& number(std::int64_t value);   // bigint
    Parameters& integer(std::int32_t value);  // integer
    Parameters& text(std::string_view value);
    Parameters& bytes(ByteView value);  // copied
    // One-dimensional arrays.
    Parameters& numbers(std::span<const std::int64_t> values);  // bigint[]
    Parameters& smallNumbers(std::span<const std::int16_t> values);
    Parameters& texts(std::span<const std::string> values);
    Parameters& byteStrings(std::span<const Bytes> values);  // bytea[]

  private:
    friend class Connection;
    void add(std::uint32_t type, std::string bytes);
    std::vector<std::uint32_t> types_;
    std::vector<std::string> values_;
};

}  // namespace terrane::store_postgres
