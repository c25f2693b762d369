#include "python/src/errors.h"

#include <chrono>
#include <string_view>

namespace py = pybind11;

namespace terrane::python {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{50};

std::string_view nameOf(base::ErrorCode code) {
    using enum base::ErrorCode;
    switch (code) {
        case Failed:
            return "failed";
        case BadInput:
            return "bad_input";
        case NotFound:
            return "not_found";
        case Io:
            return "io";
        case Damaged:
            return "damaged";
        case Incompatible:
            return "incompatible";
        case Busy:
            return "busy";
        case Unsupported:
            return "unsupported";
        case OutOfResources:
            return "out_of_resources";
        case Refused:
            return "refused";
    }
    return "failed";
}

constexpr const char* kErrorDoc =
    "What the library could not do: one line that names what failed and where.\n\n"
    "code: str, one of failed, bad_input, not_found, io, damaged, incompatible, busy, unsupported,\n"
    "out_of_resources, refused.";

// Lives until the interpreter ends.
PyObject* errorType = nullptr;

void raise(const base::Error& error) {
    py::object exception = py::handle(errorType)(error.message);
    exception.attr("code") = nameOf(error.code);
    PyErr_SetObject(errorType, exception.ptr());
}

}  // namespace

volume::ShouldContinue untilInterrupted() {
    return [last = std::chrono::steady_clock::now()]() mutable {
        const auto now = std::chrono::steady_clock::now();
        if (now - last < kBetweenLooks) return true;
        last = now;
        const py::gil_scoped_acquire locked;
        return PyErr_CheckSignals() == 0;
    };
}

void addErrors(py::module_& module) {
    const py::dict members;
    members["code"] = "failed";
    errorType = PyErr_NewExceptionWithDoc("terrane.Error", kErrorDoc, PyExc_Exception, members.ptr());
    if (errorType == nullptr) throw py::error_already_set();
    module.attr("Error") = py::handle(errorType);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Failure& failure) {
            raise(failure.error);
        }
    });
}

}  // namespace terrane::python
