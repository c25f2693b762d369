// Arguments of Python's functions. A signature names the parameters; each value is converted by a function
// below, which refuses all others with one line: the parameter, what is expected, what was given.
//
// One rule for all functions: a value of a wrong type or out of range is a Failure with BadInput. A call that
// does not fit the signature (missing, unknown or too many arguments, another self) is a TypeError. An
// integer is an int, a NumPy integer or another type with __index__; a bool or a float is none, not even 3.0.
// Called with Python's lock.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "python/src/errors.h"
#include "terrane/volume/block_area.h"

namespace terrane::python {

// A function's parameters, read from a signature as Python writes it: "heights(self, area, step=1, *,
// ground=False)". Defaults are literals.
class Signature {
  public:
    explicit Signature(std::string text);

    // The name of the function.
    const std::string& name() const { return name_; }
    // A description that begins as inspect.signature() and help() read signatures.
    std::string describedBy(std::string_view text) const;
    // The values of all parameters, defaults among them, in order. TypeError if the call does not fit.
    std::vector<pybind11::object> bind(const pybind11::args& given, const pybind11::kwargs& named) const;
    std::size_t placeOf(std::string_view parameter) const;

  private:
    struct Parameter {
        std::string name;
        pybind11::object otherwise;  // empty: required
        bool isKeywordOnly = false;
    };

    void addParameter(std::string_view text);
    pybind11::ssize_t positionalCount() const;
    void bindNamed(const pybind11::kwargs& named, std::vector<pybind11::object>& values) const;

    std::string text_, name_;
    std::vector<Parameter> parameters_;
};

// A parameter and its value.
struct Argument {
    const char* name;
    pybind11::object value;
};

// The arguments of one call.
class Arguments {
  public:
    Arguments(const Signature& signature, const pybind11::args& given, const pybind11::kwargs& named)
        : signature_(signature), values_(signature.bind(given, named)) {}
    Argument operator[](const char* name) const { return {name, values_[signature_.placeOf(name)]}; }
    const pybind11::object& self() const { return values_.front(); }

  private:
    const Signature& signature_;
    std::vector<pybind11::object> values_;
};

// Fails with "NAME: expected EXPECTED, got GIVEN".
[[noreturn]] void refuse(const Argument& argument, std::string_view expected);

std::int64_t integerFrom(const Argument& argument, std::int64_t low, std::int64_t high);
// An int or a float; not NaN.
double numberFrom(const Argument& argument, double low, double high);
constexpr double kAnyNumber = std::numeric_limits<double>::max();
bool boolFrom(const Argument& argument);
std::string textFrom(const Argument& argument);  // a str, without NUL
std::vector<std::string> textsFrom(const Argument& argument);
std::uint64_t seedFrom(const Argument& argument);  // an int, or a str by store::seedFrom

// A sequence of this many integers or numbers; `expected` describes it in messages.
std::vector<std::int64_t> integersFrom(const Argument& argument, std::span<const std::size_t> counts,
                                       std::string_view expected);
std::array<double, 3> positionFrom(const Argument& argument);

// (x0, y0, x1, y1).
std::array<std::int64_t, 4> rectangleFrom(const Argument& argument);
// (x0, y0, x1, y1) has the world's full height, (x0, y0, z0, x1, y1, z1) is a box; checked.
volume::BlockArea areaFrom(const Argument& argument, world::Heights heights);

// An array of integers of any type and layout, without a copy if it is one. Refuses other element types.
pybind11::array integerArrayFrom(const Argument& argument, std::string_view expected);
// Its elements, each from `low` to `high`.
template <class T>  // uint16 or int32
std::vector<T> elementsOf(const Argument& argument, const pybind11::array& integers, T low, T high);

// Whether the value is an integer, and not an array with dimensions.
bool isInteger(const pybind11::handle& value);

}  // namespace terrane::python
