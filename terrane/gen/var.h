// Outputs and variables of a pass: fields, which later passes read, and variables of the pass itself. See
// pass.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace terrane::gen {

// A number a column that a pass writes and later ones read.
template <class T>
struct Field {
    std::uint32_t index;
};

class Pass;

// A value that changes while the pass is written: assignments inside if_ hold where its condition does.
template <class T>
class Var {
  public:
    operator T() const;  // the value now
    Var& operator=(const T& value);
    Var& operator=(const Var& other) { return *this = static_cast<T>(other); }
    Var(const Var&) = delete;

  private:
    friend class Pass;
    Var(Pass& pass, std::size_t slot) : pass_(pass), slot_(slot) {}
    Pass& pass_;
    std::size_t slot_;
};

}  // namespace terrane::gen
