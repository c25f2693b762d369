// One pass of a generator while it is written: positions, noise, reads, variables, branches, outputs.
//
// Functions here record expressions (expr.h); nothing is computed. Made by GeneratorBuilder (builder.h);
// mistakes are collected there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/drainage/drainage.h"
#include "terrane/gen/language/expr.h"

namespace terrane::gen {

// A number per column that a pass writes and later passes read.
template <class T>
struct Field {
    std::uint32_t index;
};

class Pass;

// A value that changes while the pass is recorded: assignments inside if_ hold where its condition does.
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

// Results of noise calls that return several values: see Pass.
struct Voronoi2D {
    Float distance;  // blocks
    Float ratio;     // nearest / second nearest, 0…1
    IVec2 offset;    // blocks, to the nearest point
};

struct Voronoi3D {
    Float distance;  // blocks, by the call's metric
    Float ratio;     // nearest / second nearest, 0…1
    IVec3 offset;    // blocks, to the nearest point
};

// A wave's phase as a point of the unit disc; nearer to its middle where waves meet.
struct Stripes2D {
    Float cosine, sine;
};

class GeneratorBuilder;

class Pass {
  public:
    Int x();  // block coordinates; beyond level 0 those of the block behind the middle of the column
    Int y();
    Int z();  // 3D passes
    // Returns the number of blocks from one column to the next: 1, 2, 4, … It is a constant while recording,
    // so `if` on it omits the other branch.
    int step() const;
    world::Heights heights() const;      // of the world, constants likewise
    Block block(std::string_view name);  // "air" or a name of the registry

    template <class T>
    Var<T> var(T initial) {
        return Var<T>(*this, newSlot(T::kType, initial));
    }
    void if_(Bool condition, const std::function<void()>& then, const std::function<void()>& otherwise = {});
    // Repeats `body` while `condition` holds, at most shared::kMaxLoopRounds times. Values that change
    // between rounds are Vars made before the loop. Both functions are called once, while the pass is
    // recorded.
    void while_(const std::function<Bool()>& condition, const std::function<void()>& body);

    // The functions below return noise at this column or voxel (3D: in 3D passes). `name` makes the seed.
    // Sizes are in blocks; see noise.h and pass_noise.h.
    Float perlin2D(std::string_view name, int size, std::vector<float> weights);
    Float perlin3D(std::string_view name, int size, std::vector<float> weights);
    // Returns the noise plus grain: a random number per column with the deviation of the part that faded at
    // this level. A threshold then separates the same shares of columns; faded noise alone would favor the
    // larger share.
    Float perlin2DWithGrain(std::string_view name, int size, std::vector<float> weights);
    // Returns a random number and pair for each column with mean 0 and deviation 1.
    Float grain(std::string_view name);
    Vec2 grain2D(std::string_view name);
    // Returns the gradient per block of the noise of the same name and parameters.
    Vec2 perlin2DGradient(std::string_view name, int size, std::vector<float> weights);
    Vec3 perlin3DGradient(std::string_view name, int size, std::vector<float> weights);
    // These return simplex noise, without the artifacts of Perlin noise along the axes.
    Float simplex2D(std::string_view name, int size, std::vector<float> weights);
    Float simplex3D(std::string_view name, int size, std::vector<float> weights);
    // Returns waves of about `size` blocks whose phase grows along `direction`, of length 1. The result is 0
    // where `size` is less than a column.
    Stripes2D stripes2D(std::string_view name, int size, Vec2 direction);
    Voronoi2D voronoi2D(std::string_view name, int size, int maxPoints);
    // Returns Voronoi noise in 3D; the exponent of the metric is 2…8.
    Voronoi3D voronoi3D(std::string_view name, int size, int maxPoints, int exponent = 2);

    DrainageSample drainage(Drainage map);  // 2D passes; see drainage.h
    ValleySample valleys(Drainage map);     // of a map with gradients

    // These return a random number in [0, 1), by position.
    Float random2D(std::string_view name, Int x, Int y);
    Float random3D(std::string_view name, Int x, Int y, Int z);
    Bool randomBool2D(std::string_view name, Float probability, Int x, Int y);
    Bool randomBool3D(std::string_view name, Float probability, Int x, Int y, Int z);

    // Returns a field of an earlier pass, here or at an offset within ±kMaxReadOffset blocks (larger ones are
    // clamped). Beyond level 0 the nearest column stands for the block.
    template <class T>
    T read(Field<T> field) {
        return T(readField(field.index, T::kType));
    }
    template <class T>
    T readAt(Field<T> field, IVec2 offset) {
        return T(readFieldAt(field.index, T::kType, offset));
    }
    // Returns the slope of a field per block, measured over 4 blocks at level 0 and over two columns at other
    // levels.
    Vec2 slope(Field<Float> field);
    // Returns the lowest value of a field in the four columns beside, at every level: the ground of a column
    // shows at its sides down to there.
    Float lowestBeside(Field<Float> field);
    // Returns a field at an offset of any fraction of a block, blended from the four columns around it.
    // Offset and the block beyond it within ±kMaxReadOffset.
    Float readBetween(Field<Float> field, Vec2 offset);
    template <class T>
    void set(Field<T> field, T value) {  // 2D passes
        setField(field.index, T::kType, value);
    }
    // Sets the field to `value` at height z of the column in a 3D pass, where z is clamped into the world. It
    // must not be called inside if_ or while_.
    template <class T>
    void setAt(Field<T> field, Int z, T value) {
        setFieldAt(field.index, T::kType, z, value);
    }

    // Returns the block of the last earlier 3D pass: here (3D passes), in this column at z, which is clamped
    // into the world, or in another column within ±kMaxReadOffset.
    Block blockHere();
    Block blockInColumn(Int z);
    Block blockAt(IVec2 offset, Int z);
    void setBlock(Block block);  // 3D passes; without it the block stays
    // Returns the block of stamped shapes here, air if there is none (3D passes). In every column where
    // `shape` is the number of a shape, its foot stands at height `base`. stamp_tile.h says which block stays
    // where shapes overlap.
    Block stamp(Field<Int> shape, Field<Int> base);

    // Returns the mistakes of the builder so far.
    const std::vector<std::string>& mistakes() const;
    std::size_t nodeCount() const { return graph_.graph.size(); }

  private:
    template <class T>
    friend class Var;
    friend class GeneratorBuilder;
    Pass(GeneratorBuilder& generator, int number, std::string name, bool is3D);

    struct Slot {
        Type type;
        NodeId value;
        bool hasEnded = false;  // made in a loop that is over
    };
    std::size_t newSlot(Type type, Value value);
    Value slotValue(std::size_t slot) { return {&graph_.graph, slots_[slot].value}; }
    void assign(std::size_t slot, Value value);
    Value leaf(Op op, Type type, std::uint32_t imm, std::uint8_t dependence);
    Value noise(const NoiseCall& call, std::uint32_t result, Type type);
    NoiseCall checkedNoise(std::string_view kind, NoiseCall call);
    Float sumOfOctaves(const NoiseCall& call);
    // Returns a hash of two or three coordinates; `seedName`: see randomSeedName and noiseSeedName.
    Int hash(const std::string& seedName, std::uint32_t octave, std::span<const Int> position);
    std::function<Int(std::span<const Int>)> latticeHash(const NoiseCall& call, std::size_t octave);
    std::array<Float, 3> gradient(const NoiseCall& call, std::span<const Int> position);
    Value readField(std::uint32_t field, Type type);
    Value readFieldAt(std::uint32_t field, Type type, IVec2 offset);
    Value readColumn(std::uint32_t field, Type type, IVec2 columns);
    IVec2 nearestColumn(IVec2 offset) const;
    void setField(std::uint32_t field, Type type, Value value);
    void setFieldAt(std::uint32_t field, Type type, Int z, Value value);
    bool claimField(std::uint32_t field);
    void checkOffset(std::string_view what, IVec2 offset);
    bool require3D(std::string_view what);
    bool requireField(std::uint32_t field, Type type);
    bool requireWritten(std::uint32_t field, Type type);
    bool requireBlocks();
    const DrainageGraph* drainageMap(Drainage map);  // null after a mistake
    void error(std::string_view message);
    PassGraph finish();

    GeneratorBuilder& generator_;
    int number_;
    PassGraph graph_;
    std::vector<Slot> slots_;
    std::vector<std::optional<std::size_t>> fieldSlots_;  // by field; fields of earlier passes have none
    std::optional<std::size_t> blockSlot_;
    int branchDepth_ = 0;  // of if_ and while_
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
