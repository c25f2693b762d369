#include "terrane/base/stop_signals.h"

namespace terrane::base {
namespace {

// A signal handler may access nothing else.
volatile std::sig_atomic_t wasAsked = 0;

void ask(int) {
    wasAsked = 1;
}

}  // namespace

StopSignals::StopSignals() {
    wasAsked = 0;
    for (std::size_t k = 0; k < kSignals.size(); ++k) {
        before_[k] = std::signal(kSignals[k], ask);
        if (kSignals[k] == SIGHUP && before_[k] == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
    }
}

StopSignals::~StopSignals() {
    for (std::size_t k = 0; k < kSignals.size(); ++k) std::signal(kSignals[k], before_[k]);
}

bool StopSignals::stopAsked() const {
    return wasAsked != 0;
}

}  // namespace terrane::base
