// Maps errors of the library to Python's exception terrane.Error, and runs long work without Python's lock.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <utility>

#include "terrane/base/result.h"
#include "terrane/volume/opened_world.h"

namespace terrane::python {

// Thrown in functions called by Python; becomes terrane.Error.
struct Failure : std::exception {
    explicit Failure(base::Error theError) : error(std::move(theError)) {}
    const char* what() const noexcept override { return error.message.c_str(); }
    base::Error error;
};

template <class T>
T valueOr(base::Result<T> result) {
    if (!result) throw Failure(std::move(result.error()));
    if constexpr (!std::is_void_v<T>) return std::move(*result);
}

// A callback for work on the calling thread: checks every 50 ms whether the user pressed Ctrl+C. Call without
// Python's lock.
volume::ShouldContinue untilInterrupted();

// Runs work() without Python's lock and returns its value. Throws Failure, or the exception of a signal
// handler.
template <class Work>
auto withoutLock(const Work& work) {
    auto result = [&] {
        const pybind11::gil_scoped_release unlocked;
        return work();
    }();
    if (PyErr_Occurred()) throw pybind11::error_already_set();
    return valueOr(std::move(result));
}

void addErrors(pybind11::module_& module);

}  // namespace terrane::python
