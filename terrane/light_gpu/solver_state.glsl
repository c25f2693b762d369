// Progress of the rounds: SolverState in light_workspace.cpp.
layout(std430, binding = kSolverStateBinding) buffer State {
    SolverRound rounds[kSolverRounds + 1u];  // the last one is the first of the next submission
    uint brickCount;                         // in the result
    // No uniforms: zink of Mesa 22.3 keeps old values of uniforms that bound loops.
    uint chunkCount;
    uint sectionCount;  // of a chunk
};
