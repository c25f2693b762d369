// How far the rounds are: the host's SolverState (light_workspace.cpp).
layout(std430, binding = kSolverStateBinding) buffer State {
    SolverRound rounds[kSolverRounds + 1u];  // the last is the first one of the rounds that are given next
    uint brickCount;                         // in the result
};
