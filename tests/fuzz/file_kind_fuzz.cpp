// libFuzzer: any bytes as a file whose kind is asked, plain or compressed. Each kind can be imported or has
// an advice.
#include "terrane/formats/file_kind.h"
#include "terrane/formats/nbt.h"
#include "tests/fuzz/fuzz_input.h"

using namespace terrane;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::FuzzInput input(data, size);
    const bool isCompressed = input.byte() % 4 == 3;
    const std::string bytes(input.restAsText());
    const formats::FileKind* kind = formats::kindOfFile("file", isCompressed ? formats::gzip(bytes) : bytes);
    fuzz::require(!kind || (!kind->name.empty() && kind->format.empty() != kind->advice.empty()));
    return 0;
}
