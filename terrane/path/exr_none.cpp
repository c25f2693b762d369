// A build without OpenEXR.
#include "terrane/path/exr.h"

namespace terrane::path {

base::Result<void> writeExr(const std::filesystem::path& path, const Means&, const ExrNotes&) {
    return base::fail(base::ErrorCode::Unsupported, "{}: this program was built without OpenEXR",
                      path.string());
}

bool hasExr() {
    return false;
}

}  // namespace terrane::path
