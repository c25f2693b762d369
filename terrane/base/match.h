// Handles every alternative of a variant: one that is forgotten does not compile. Any thread may use it.
#pragma once

#include <concepts>
#include <type_traits>

namespace terrane::base {

// std::visit(Match{[](const A& a) { … }, [](const B& b) { … }}, variant);
template <class... Functions>
struct Match : Functions... {
    using Functions::operator()...;
};
template <class... Functions>
Match(Functions...) -> Match<Functions...>;

// Also for a function of several alternatives: [](const base::OneOf<C, D> auto&) { … }.
template <class T, class... Alternatives>
concept OneOf = (std::same_as<std::remove_cvref_t<T>, Alternatives> || ...);

}  // namespace terrane::base
