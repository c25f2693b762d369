// The text in which a world stores the values of scripts: plain ASCII, the same for equal values on every
// machine. Any thread may use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace terrane::rules {

constexpr std::size_t kMaxStoredBytes = std::size_t{64} << 10;  // the text of one value
constexpr int kMaxStoredDepth = 16;                             // of tables in tables

// true or false, a whole number, another finite number, bytes, or a table: its keys and values.
struct StoredValue {
    using Table = std::vector<std::pair<StoredValue, StoredValue>>;
    std::variant<bool, std::int64_t, double, std::string, Table> value = false;

    bool operator==(const StoredValue&) const = default;
};

// Appends the text of a value to `text`:
//
//     t  f  i-12;  d0.5;  s5:a%0Ab;  {<key><value>…}
//
// The number of a string counts its escaped bytes; all but printable ASCII, and %, is escaped.
void encodeStored(std::string& text, const StoredValue& value);
// Decodes any bytes; nothing unless they are the text of one value within the limits.
std::optional<StoredValue> decodeStored(std::string_view text);

// Escapes a key of scripts for the name of a setting of a world: letters, digits, _, - and . stay.
std::string escapedKey(std::string_view key);

}  // namespace terrane::rules
