// Writes a generator: a list of passes over columns (2D) and voxels (3D), as C++ expressions.
//
//   GeneratorBuilder g("hills", blocks);
//   auto height = g.field<Float>("height");
//   g.pass2D("terrain", [&](Pass& p) { p.set(height, 80.0f + 20.0f * p.perlin2D("hills", 64, {1.0f, 2.0f}));
//   }); g.pass3D("ground", [&](Pass& p) {
//       p.setBlock(select(Float(p.z()) <= p.read(height), p.block("stone"), p.block("air")));
//   });
//   auto program = g.finish();
//
// Used on one thread. Mistakes (unknown block, offset too large, a name used twice) are collected and
// reported by finish(), each with pass and name.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/expr.h"
#include "terrane/gen/generator_graph.h"
#include "terrane/world/block_registry.h"

namespace terrane::gen {

template <class T>
struct Field {
    std::uint32_t index;
};

class GeneratorBuilder;
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

struct Voronoi2D {
    Float distance;  // blocks
    Float ratio;     // nearest / second nearest, 0…1
    IVec2 offset;    // blocks, to the nearest point
};

class Pass {
  public:
    Int x();
    Int y();
    Int z();                             // 3D passes
    Block block(std::string_view name);  // "air" or a name of the registry

    template <class T>
    Var<T> var(T initial) {
        return Var<T>(*this, newSlot(T::kType, initial));
    }
    void if_(Bool condition, const std::function<void()>& then, const std::function<void()>& otherwise = {});

    // Noise at this column or voxel. `name` makes the seed. Sizes in blocks; see noise.h.
    Float perlin2D(std::string_view name, int size, std::vector<float> weights);
    Float perlin3D(std::string_view name, int size, std::vector<float> weights);  // 3D passes
    Voronoi2D voronoi2D(std::string_view name, int size, int maxPoints);

    // In [0, 1), by position.
    Float random2D(std::string_view name, Int x, Int y);
    Float random3D(std::string_view name, Int x, Int y, Int z);

    // A field of an earlier pass, here or at an offset within ±kMaxReadOffset (larger ones are clamped).
    template <class T>
    T read(Field<T> field) {
        return T(readField(field.index, T::kType));
    }
    template <class T>
    T readAt(Field<T> field, IVec2 offset) {
        return T(readFieldAt(field.index, T::kType, offset));
    }
    template <class T>
    void set(Field<T> field, T value) {
        setField(field.index, T::kType, value);
    }

    // The block that the newest earlier 3D pass put here (3D passes), or in this column at z, clamped into
    // the world.
    Block blockHere();
    Block blockInColumn(Int z);
    void setBlock(Block block);  // 3D passes; without it the block stays

  private:
    template <class T>
    friend class Var;
    friend class GeneratorBuilder;
    Pass(GeneratorBuilder& generator, int number, std::string name, bool is3D);

    struct Slot {
        Type type;
        NodeId value;
    };
    std::size_t newSlot(Type type, Value value);
    Value slotValue(std::size_t slot) { return {&graph_.graph, slots_[slot].value}; }
    void assign(std::size_t slot, Value value);
    Value leaf(Op op, Type type, std::uint32_t imm, std::uint8_t dependence);
    Value noise(NoiseCall call, std::uint32_t result, Type type);
    Value readField(std::uint32_t field, Type type);
    Value readFieldAt(std::uint32_t field, Type type, IVec2 offset);
    void setField(std::uint32_t field, Type type, Value value);
    bool require3D(std::string_view what);
    bool requireWritten(std::uint32_t field);
    bool requireBlocks();
    void error(std::string_view message);
    PassGraph finish();

    GeneratorBuilder& generator_;
    int number_;
    PassGraph graph_;
    std::vector<Slot> slots_;
    std::vector<std::optional<std::size_t>> fieldSlots_;  // by field; fields of earlier passes have none
    std::optional<std::size_t> blockSlot_;
};

class GeneratorBuilder {
  public:
    GeneratorBuilder(std::string name, const world::BlockRegistry& blocks);

    template <class T>
    Field<T> field(std::string_view name) {
        return {newField(name, T::kType)};
    }
    void pass2D(std::string name, const std::function<void(Pass&)>& body) {
        addPass(std::move(name), false, body);
    }
    void pass3D(std::string name, const std::function<void(Pass&)>& body) {
        addPass(std::move(name), true, body);
    }

    base::Result<GeneratorGraph> finish();

  private:
    friend class Pass;
    int newest3D() const;  // number of the newest finished 3D pass, or -1
    std::uint32_t newField(std::string_view name, Type type);
    void addPass(std::string name, bool is3D, const std::function<void(Pass&)>& body);
    std::uint32_t noiseIndex(Pass& pass, NoiseCall call);
    std::uint32_t randomSlot(std::string_view name);

    GeneratorGraph generator_;
    const world::BlockRegistry& blocks_;
    std::vector<std::string> errors_;
};

template <class T>
Var<T>::operator T() const {
    return T(pass_.slotValue(slot_));
}

template <class T>
Var<T>& Var<T>::operator=(const T& value) {
    pass_.assign(slot_, value);
    return *this;
}

}  // namespace terrane::gen
