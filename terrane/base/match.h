// Handles every alternative of a variant: one that is forgotten does not compile. Any thread may use it.
#pragma once

#include <utility>

namespace terrane::base {

// std::visit(Match{[](const A& a) { … }, [](const B& b) { … }}, variant);
template <class... Functions>
struct Match : Functions... {
    using Functions::operator()...;
};
template <class... Functions>
Match(Functions...) -> Match<Functions...>;

// Makes one function of a Match for several alternatives, without their values: on<C, D>([] { … }).
template <class... Alternatives, class Function>
auto on(Function function) {
    return Match{[function](const Alternatives&) { return function(); }...};
}

}  // namespace terrane::base
