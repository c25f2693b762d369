#include "terrane/formats/deflate.h"

#include <zlib.h>

#include <algorithm>
#include <new>

namespace terrane::formats {
namespace {

constexpr int kAnyWindow = 15 + 32;   // zlib or gzip, as the header says
constexpr int kGzipWindow = 15 + 16;  // gzip
constexpr int kMemoryLevel = 8;       // zlib's default
constexpr std::size_t kPieceBytes = std::size_t{64} << 10;

const Bytef* inputOf(std::string_view bytes) {
    return reinterpret_cast<const Bytef*>(bytes.data());
}

struct Inflater {
    z_stream stream{};

    Inflater() {
        if (inflateInit2(&stream, kAnyWindow) != Z_OK) throw std::bad_alloc();
    }
    ~Inflater() { inflateEnd(&stream); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
};

}  // namespace

base::Result<std::string> inflate(std::string_view bytes, std::size_t maxBytes) {
    if (bytes.size() > UINT32_MAX)
        return base::fail(base::ErrorCode::OutOfResources, "{} compressed bytes are too many", bytes.size());
    Inflater inflater;
    z_stream& stream = inflater.stream;
    stream.next_in = inputOf(bytes);
    stream.avail_in = static_cast<uInt>(bytes.size());
    std::string out;
    for (int status = Z_OK; status != Z_STREAM_END;) {
        const std::size_t done = out.size();
        if (done > maxBytes)
            return base::fail(base::ErrorCode::OutOfResources, "more than {} bytes when decompressed",
                              maxBytes);
        out.resize(done + kPieceBytes);
        stream.next_out = reinterpret_cast<Bytef*>(out.data() + done);
        stream.avail_out = static_cast<uInt>(kPieceBytes);
        status = ::inflate(&stream, Z_NO_FLUSH);
        out.resize(out.size() - stream.avail_out);
        const bool isStuck = status == Z_BUF_ERROR || (status == Z_OK && out.size() == done);
        if (isStuck) return base::fail(base::ErrorCode::Damaged, "the compressed data are cut off");
        if (status != Z_OK && status != Z_STREAM_END)
            return base::fail(base::ErrorCode::Damaged, "the compressed data are damaged");
    }
    if (out.size() > maxBytes)
        return base::fail(base::ErrorCode::OutOfResources, "more than {} bytes when decompressed", maxBytes);
    return out;
}

std::string gzip(std::string_view bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipWindow, kMemoryLevel,
                     Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    std::string out;
    std::size_t taken = 0;
    for (int status = Z_OK; status != Z_STREAM_END;) {
        if (stream.avail_in == 0 && taken < bytes.size()) {
            const std::size_t piece = std::min(bytes.size() - taken, std::size_t{1} << 30);
            stream.next_in = inputOf(bytes.substr(taken));
            stream.avail_in = static_cast<uInt>(piece);
            taken += piece;
        }
        const std::size_t done = out.size();
        out.resize(done + kPieceBytes);
        stream.next_out = reinterpret_cast<Bytef*>(out.data() + done);
        stream.avail_out = static_cast<uInt>(kPieceBytes);
        status = ::deflate(&stream, taken == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
        out.resize(out.size() - stream.avail_out);
    }
    deflateEnd(&stream);
    return out;
}

}  // namespace terrane::formats
