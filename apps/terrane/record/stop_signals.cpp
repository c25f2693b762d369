#include "apps/terrane/record/stop_signals.h"

#include <csignal>

namespace terrane::app {
namespace {

// A signal handler reaches nothing else.
volatile std::sig_atomic_t wasAsked = 0;

void ask(int) {
    wasAsked = 1;
}

}  // namespace

StopSignals::StopSignals() {
    wasAsked = 0;
    std::signal(SIGINT, ask);
    std::signal(SIGTERM, ask);
}

StopSignals::~StopSignals() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool StopSignals::stopAsked() const {
    return wasAsked != 0;
}

}  // namespace terrane::app
