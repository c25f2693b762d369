#include "terrane/base/result.h"

#include <new>
#include <system_error>

namespace terrane::base {

const char* textOf(const std::exception& exception) noexcept {
    if (dynamic_cast<const std::bad_alloc*>(&exception)) return "no memory";
    const auto* failure = dynamic_cast<const std::system_error*>(&exception);
    // Only starting a thread throws this: files report their errors by codes.
    if (failure && failure->code() == std::errc::resource_unavailable_try_again)
        return "no thread can be started: too little memory, or too many threads";
    return exception.what();
}

}  // namespace terrane::base
