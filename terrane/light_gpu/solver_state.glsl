// How far the rounds are. terrane/light_gpu/cells.glsl comes before it.
layout(std430, binding = kSolverStateBinding) buffer State {
    SolverState state;
};
