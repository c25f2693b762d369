#include "python/src/arguments.h"

#include <pybind11/eval.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "terrane/store/saves/world_identity.h"

namespace py = pybind11;

namespace terrane::python {
namespace {

constexpr std::size_t kMaxShownBytes = 60;

bool isBool(const py::handle& value) {
    return PyBool_Check(value.ptr()) || py::isinstance(value, py::module_::import("numpy").attr("bool_"));
}

// UTF-8; none for lone surrogates, which have no such form.
std::optional<std::string> utf8(const py::handle& text) {
    Py_ssize_t size = 0;
    const char* bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
    if (bytes != nullptr) return std::string(bytes, static_cast<std::size_t>(size));
    PyErr_Clear();
    return std::nullopt;
}

std::string withoutLineBreaks(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
    return text;
}

// At most kMaxShownBytes, cut between characters.
std::string shortened(std::string text) {
    if (text.size() <= kMaxShownBytes) return text;
    std::size_t end = kMaxShownBytes;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
    return text.substr(0, end) + "…";
}

std::string typeName(const py::handle& value) {
    return Py_TYPE(value.ptr())->tp_name;
}

// "an array of float64 [3, 2]"
std::string shownArray(const py::array& array) {
    std::string sides;
    for (py::ssize_t k = 0; k < array.ndim(); ++k)
        sides += fmt::format("{}{}", k > 0 ? ", " : "", array.shape(k));
    return fmt::format("an array of {} [{}]", py::str(array.dtype()).cast<std::string>(), sides);
}

// A value in a message; never fails, whatever its __repr__ does.
std::string shown(const py::handle& value) {
    if (py::isinstance<py::array>(value)) return shownArray(py::reinterpret_borrow<py::array>(value));
    try {
        const py::object text = py::module_::import("reprlib").attr("repr")(value);  // short for long lists
        if (const auto bytes = utf8(text)) return shortened(withoutLineBreaks(*bytes));
    } catch (const py::error_already_set&) {
    }
    return fmt::format("a value of type {}", typeName(value));
}

// Clears a TypeError or a ValueError of a conversion, and throws any other error.
void clearConversionError() {
    if (PyErr_ExceptionMatches(PyExc_TypeError) || PyErr_ExceptionMatches(PyExc_ValueError) ||
        PyErr_ExceptionMatches(PyExc_OverflowError))
        PyErr_Clear();
    else
        throw py::error_already_set();
}

// The int that a value is; none if it is no integer.
py::object indexOf(const py::handle& value) {
    if (!isInteger(value)) return {};
    auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    if (!index) clearConversionError();
    return index;
}

std::optional<std::int64_t> signedOf(const py::object& index) {
    int overflow = 0;
    const long long value = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
    return overflow == 0 ? std::optional<std::int64_t>(value) : std::nullopt;
}

bool isSequence(const py::handle& value) {
    return PySequence_Check(value.ptr()) && !PyUnicode_Check(value.ptr()) && !PyBytes_Check(value.ptr());
}

// The elements of a sequence; none if it is no sequence or has more than `most` of them.
std::optional<std::vector<py::object>> itemsOf(const py::handle& value, std::size_t most) {
    if (!isSequence(value)) return std::nullopt;
    const Py_ssize_t size = PySequence_Size(value.ptr());
    if (size < 0) clearConversionError();
    if (size < 0 || static_cast<std::size_t>(size) > most) return std::nullopt;
    std::vector<py::object> elements;
    for (Py_ssize_t k = 0; k < size; ++k) {
        auto element = py::reinterpret_steal<py::object>(PySequence_GetItem(value.ptr(), k));
        if (!element) throw py::error_already_set();
        elements.push_back(std::move(element));
    }
    return elements;
}

[[noreturn]] void wrongCall(std::string text) {
    throw py::type_error(std::move(text));
}

// Splits at commas outside of brackets.
std::vector<std::string> splitParameters(std::string_view text) {
    std::vector<std::string> parts(1);
    int depth = 0;
    for (const char c : text) {
        depth += (c == '(') - (c == ')');
        if (c == ',' && depth == 0)
            parts.emplace_back();
        else if (c != ' ' || !parts.back().empty())
            parts.back() += c;
    }
    if (parts.back().empty()) parts.pop_back();
    return parts;
}

}  // namespace

Signature::Signature(std::string text) : text_(std::move(text)) {
    const std::size_t open = text_.find('(');
    name_ = text_.substr(0, open);
    bool isKeywordOnly = false;
    for (const std::string& part :
         splitParameters(std::string_view(text_).substr(open + 1, text_.size() - open - 2))) {
        if (part == "*") {
            isKeywordOnly = true;
            continue;
        }
        addParameter(part);
        parameters_.back().isKeywordOnly = isKeywordOnly;
    }
}

void Signature::addParameter(std::string_view text) {
    const std::size_t equals = text.find('=');
    Parameter& parameter = parameters_.emplace_back();
    parameter.name = text.substr(0, equals);
    if (equals != text.npos) parameter.otherwise = py::eval(std::string(text.substr(equals + 1)));
}

std::string Signature::describedBy(std::string_view text) const {
    return fmt::format("{}\n--\n\n{}", text_, text);
}

py::ssize_t Signature::positionalCount() const {
    return std::ranges::count(parameters_, false, &Parameter::isKeywordOnly);
}

std::vector<py::object> Signature::bind(const py::args& given, const py::kwargs& named) const {
    const auto count = static_cast<py::ssize_t>(given.size());
    if (count > positionalCount())
        wrongCall(fmt::format("{}() takes at most {} positional arguments, got {}", name_, positionalCount(),
                              count));
    std::vector<py::object> values(parameters_.size());
    for (py::ssize_t k = 0; k < count; ++k)
        values[static_cast<std::size_t>(k)] = given[static_cast<std::size_t>(k)];
    bindNamed(named, values);
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (values[k]) continue;
        if (!parameters_[k].otherwise)
            wrongCall(fmt::format("{}() needs an argument for '{}'", name_, parameters_[k].name));
        values[k] = parameters_[k].otherwise;
    }
    return values;
}

void Signature::bindNamed(const py::kwargs& named, std::vector<py::object>& values) const {
    for (const auto& [key, value] : named) {
        const auto parameter = std::ranges::find(parameters_, utf8(key), &Parameter::name);
        if (parameter == parameters_.end())
            wrongCall(fmt::format("{}() has no parameter {}", name_, shown(key)));
        py::object& place = values[static_cast<std::size_t>(parameter - parameters_.begin())];
        if (place) wrongCall(fmt::format("{}() has two arguments for '{}'", name_, parameter->name));
        place = py::reinterpret_borrow<py::object>(value);
    }
}

std::size_t Signature::placeOf(std::string_view parameter) const {
    const auto found = std::ranges::find(parameters_, parameter, &Parameter::name);
    base::require(found != parameters_.end(), "Signature::placeOf: an unknown parameter");
    return static_cast<std::size_t>(found - parameters_.begin());
}

void refuse(const Argument& argument, std::string_view expected) {
    throw Failure({base::ErrorCode::BadInput,
                   fmt::format("{}: expected {}, got {}", argument.name, expected, shown(argument.value))});
}

bool isInteger(const py::handle& value) {
    if (isBool(value) || !PyIndex_Check(value.ptr())) return false;
    if (!py::isinstance<py::array>(value)) return true;
    const auto array = py::reinterpret_borrow<py::array>(value);
    return array.ndim() == 0 && (array.dtype().kind() == 'i' || array.dtype().kind() == 'u');
}

std::int64_t integerFrom(const Argument& argument, std::int64_t low, std::int64_t high) {
    const py::object index = indexOf(argument.value);
    const auto value = index ? signedOf(index) : std::nullopt;
    if (!value || *value < low || *value > high)
        refuse(argument, fmt::format("an integer from {} to {}", low, high));
    return *value;
}

double numberFrom(const Argument& argument, double low, double high) {
    const auto wrong = [&] {
        refuse(argument,
               high == kAnyNumber ? "a finite number" : fmt::format("a number from {} to {}", low, high));
    };
    const py::object& value = argument.value;
    const bool isNumber = PyFloat_Check(value.ptr()) || isInteger(value) ||
                          py::isinstance(value, py::module_::import("numpy").attr("floating"));
    if (!isNumber) wrong();
    const double number = PyFloat_AsDouble(value.ptr());
    if (number == -1 && PyErr_Occurred()) {
        clearConversionError();
        wrong();
    }
    if (!(number >= low && number <= high)) wrong();  // NaN is not within
    return number;
}

bool boolFrom(const Argument& argument) {
    if (!isBool(argument.value)) refuse(argument, "True or False");
    return PyObject_IsTrue(argument.value.ptr()) == 1;
}

std::string textFrom(const Argument& argument) {
    const auto text = PyUnicode_Check(argument.value.ptr()) ? utf8(argument.value) : std::nullopt;
    if (!text) refuse(argument, "a str");
    if (text->find('\0') != text->npos) refuse(argument, "a str without NUL characters");
    return *text;
}

std::vector<std::string> textsFrom(const Argument& argument) {
    constexpr std::size_t kMaxTexts = 10'000;  // a sequence without an end is none
    const auto elements = itemsOf(argument.value, kMaxTexts);
    if (!elements) refuse(argument, "a sequence of str");
    std::vector<std::string> texts;
    for (const py::object& element : *elements) texts.push_back(textFrom({argument.name, element}));
    return texts;
}

std::uint64_t seedFrom(const Argument& argument) {
    constexpr const char* kExpected = "an integer from -2^63 to 2^64 - 1, or a str";
    if (PyUnicode_Check(argument.value.ptr())) {
        const auto seed = store::seedFrom(textFrom(argument));
        if (!seed)
            throw Failure({seed.error().code, fmt::format("{}: {}", argument.name, seed.error().message)});
        return seed->seed;
    }
    const py::object index = indexOf(argument.value);
    if (!index) refuse(argument, kExpected);
    if (const auto seed = signedOf(index)) return static_cast<std::uint64_t>(*seed);
    const unsigned long long seed = PyLong_AsUnsignedLongLong(index.ptr());
    if (!PyErr_Occurred()) return seed;
    clearConversionError();
    refuse(argument, kExpected);
}

std::vector<std::int64_t> integersFrom(const Argument& argument, std::span<const std::size_t> counts,
                                       std::string_view expected) {
    const auto elements = itemsOf(argument.value, std::ranges::max(counts));
    if (!elements || std::ranges::find(counts, elements->size()) == counts.end()) refuse(argument, expected);
    std::vector<std::int64_t> values;
    for (const py::object& element : *elements) {
        const py::object index = indexOf(element);
        const auto value = index ? signedOf(index) : std::nullopt;
        if (!value) refuse({argument.name, element}, "integers of 64 bits");
        values.push_back(*value);
    }
    return values;
}

std::array<double, 3> positionFrom(const Argument& argument) {
    const auto elements = itemsOf(argument.value, 3);
    if (!elements || elements->size() != 3) refuse(argument, "(x, y, z)");
    constexpr double kEdge = 2147483648.0, kFarUp = 1e6;
    const auto along = [&](std::size_t axis, double low, double high) {
        return numberFrom({argument.name, (*elements)[axis]}, low, high);
    };
    const auto inWorld = [&](std::size_t axis) {
        const double number = along(axis, -kAnyNumber, kAnyNumber);
        if (number < -kEdge || number >= kEdge)  // the last column ends before kEdge
            refuse({argument.name, (*elements)[axis]},
                   fmt::format("a number from {} to less than {}", -kEdge, kEdge));
        return number;
    };
    return {inWorld(0), inWorld(1), along(2, -kFarUp, kFarUp)};
}

std::array<std::int64_t, 4> rectangleFrom(const Argument& argument) {
    constexpr std::array<std::size_t, 1> kCounts = {4};
    const auto n = integersFrom(argument, kCounts, "(x0, y0, x1, y1)");
    return {n[0], n[1], n[2], n[3]};
}

volume::BlockArea areaFrom(const Argument& argument, world::Heights heights) {
    constexpr std::array<std::size_t, 2> kCounts = {4, 6};
    const auto n = integersFrom(argument, kCounts, "(x0, y0, x1, y1) or (x0, y0, z0, x1, y1, z1)");
    const volume::BlockArea area =
        n.size() == 4 ? volume::BlockArea{n[0], n[1], heights.bottom, n[2], n[3], heights.top}
                      : volume::BlockArea{n[0], n[1], n[2], n[3], n[4], n[5]};
    valueOr(volume::checkArea(area, heights));
    return area;
}

py::array integerArrayFrom(const Argument& argument, std::string_view expected) {
    auto array = py::reinterpret_steal<py::object>(
        py::detail::npy_api::get().PyArray_FromAny_(argument.value.ptr(), nullptr, 0, 0, 0, nullptr));
    if (!array) {
        clearConversionError();
        refuse(argument, expected);
    }
    const auto integers = py::reinterpret_steal<py::array>(array.release());
    const char kind = integers.dtype().kind();
    if (kind == 'i' || kind == 'u') return integers;
    if (py::isinstance<py::array>(argument.value) || !isSequence(argument.value)) refuse(argument, expected);
    throw Failure({base::ErrorCode::BadInput,
                   fmt::format("{}: expected {}, got {}", argument.name, expected, shownArray(integers))});
}

namespace {

template <class T, class Wide>
std::vector<T> narrowed(const Argument& argument, const py::array& integers, T low, T high) {
    const py::array_t<Wide, py::array::c_style | py::array::forcecast> wide(integers);
    std::vector<T> values(static_cast<std::size_t>(wide.size()));
    for (std::size_t k = 0; k < values.size(); ++k) {
        const Wide value = wide.data()[k];
        if (std::cmp_less(value, low) || std::cmp_greater(value, high))
            throw Failure(
                {base::ErrorCode::BadInput, fmt::format("{}: expected integers from {} to {}, got {}",
                                                        argument.name, low, high, value)});
        values[k] = static_cast<T>(value);
    }
    return values;
}

}  // namespace

template <class T>
std::vector<T> elementsOf(const Argument& argument, const py::array& integers, T low, T high) {
    if (integers.dtype().kind() == 'u') return narrowed<T, std::uint64_t>(argument, integers, low, high);
    return narrowed<T, std::int64_t>(argument, integers, low, high);
}
template std::vector<std::uint16_t> elementsOf(const Argument&, const py::array&, std::uint16_t,
                                               std::uint16_t);
template std::vector<std::int32_t> elementsOf(const Argument&, const py::array&, std::int32_t, std::int32_t);

}  // namespace terrane::python
