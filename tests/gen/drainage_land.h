// A land with a sea for the tests of drainage, and a generator that stores all results of a map.
#pragma once

#include <array>
#include <vector>

#include "terrane/gen/cpu/executor.h"
#include "terrane/gen/drainage/drainage_curves.h"
#include "terrane/gen/drainage/drainage_maps.h"
#include "terrane/shared/det_math.h"
#include "terrane/shared/hash.h"
#include "tests/gen/gen_fixture.h"

namespace terrane::gen {

inline Float drainageLand(Pass& p) {
    return 66.0f + p.perlin2D("land", 128, {4.0f, 10.0f, 20.0f, 30.0f, 20.0f});
}

constexpr DrainageSpec kDrainageSpec = {
    .spacing = 64, .seaLevel = 62.0f, .minFlow = 6, .reach = 48.0f, .lakeDepth = 6.0f};

inline Float drainageGradient(Pass& p) {
    return 0.2f + p.perlin2D("steep", 128, {0.1f, 0.1f});
}

enum class Valleys { No, Yes };

// Of DrainageSample, then of ValleySample if the map has valleys.
using DrainageResults = std::vector<ColumnValues>;

// A generator of any level with one map, read by its first pass into fields 0 to 6, with valleys to 9.
class DrainageRunner {
  public:
    explicit DrainageRunner(std::uint64_t seed, int level = 0, DrainageSpec spec = kDrainageSpec,
                            Valleys valleys = Valleys::No)
        : graph(makeGraph(level, spec, valleys)),
          maps(graph.drainages, seed),
          seeds_(makeSeeds(graph, seed)),
          program_(compile(graph.passes[0], graph.noises)),
          executor_(graph.noises, seeds_, {.drainages = &maps}) {}

    DrainageResults run(ChunkPos chunk) {
        DrainageResults results(graph.fields.size());
        std::vector<ColumnValues*> pointers;
        for (ColumnValues& values : results) pointers.push_back(&values);
        PassInputs inputs;
        inputs.chunk = chunk;
        inputs.fields.resize(graph.fields.size());
        executor_.run2D(program_, inputs, pointers);
        return results;
    }

    static void write(GeneratorBuilder& g, DrainageSpec spec, Valleys valleys) {
        std::vector<Field<Float>> fields;
        for (const char* name :
             {"distance", "half width", "level", "flow", "lake distance", "lake level", "fall"}) {
            fields.push_back(g.field<Float>(name));
        }
        const Drainage map = valleys == Valleys::Yes
                                 ? g.drainage("rivers", spec, drainageLand, drainageGradient)
                                 : g.drainage("rivers", spec, drainageLand);
        if (valleys == Valleys::Yes) {
            for (const char* name : {"from stream", "stream level", "stream flow"})
                fields.push_back(g.field<Float>(name));
        }
        g.pass2D("water", [&](Pass& p) {
            const DrainageSample s = p.drainage(map);
            std::vector<Float> values = {s.distance,     s.halfWidth, s.level, s.flow,
                                         s.lakeDistance, s.lakeLevel, s.fall};
            if (valleys == Valleys::Yes) {
                const ValleySample v = p.valleys(map);
                values.insert(values.end(), {v.distance, v.level, v.flow});
            }
            for (std::size_t k = 0; k < fields.size(); ++k) p.set(fields[k], values[k]);
        });
        // Every bit of them counts in some block.
        g.pass3D("blocks", [&](Pass& p) {
            Int sum = p.z() & 1;
            for (const Field<Float> f : fields)
                sum = sum * 7 + floatBits(p.read(f)) + (floatBits(p.read(f)) >> 11);
            p.setBlock(Block(sum ^ (sum >> 16)));
        });
    }

    GeneratorGraph graph;
    DrainageMaps maps;

  private:
    static GeneratorGraph makeGraph(int level, DrainageSpec spec, Valleys valleys) {
        GeneratorBuilder builder("drained", testBlocks(), level);
        write(builder, spec, valleys);
        auto graph = builder.finish();
        EXPECT_TRUE(graph.has_value()) << (graph ? "" : graph.error().message);
        return graph ? std::move(*graph) : GeneratorGraph();
    }

    Seeds seeds_;
    Program program_;
    Executor executor_;
};

}  // namespace terrane::gen
