// libFuzzer: any bytes as a value that rules stored (terrane/rules/stored_value.h). What decodes has one
// text.
#include "terrane/rules/stored_value.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terrane;
    const auto value = rules::decodeStored(fuzz::FuzzInput(data, size).restAsText());
    if (!value) return 0;
    std::string text;
    rules::encodeStored(text, *value);
    if (text.size() > rules::kMaxStoredBytes) return 0;  // numbers may be longer than they were written
    fuzz::require(rules::decodeStored(text) == value);
    return 0;
}
