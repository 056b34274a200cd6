// SPDX-License-Identifier: Apache-2.0
#include "stop.h"

#include <atomic>
#include <csignal>

namespace asperity::cli {

namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

std::atomic<Run*> running{nullptr};
static_assert(std::atomic<Run*>::is_always_lock_free, "a signal handler may use it");

}  // namespace

extern "C" {
static void ask_to_stop(int) {
    if (Run* run = running.load()) run->request_stop();
}
}

StopOnSignal::StopOnSignal(Run& run) {
    running = &run;
    struct sigaction action = {};
    action.sa_handler = ask_to_stop;
    // Back to the default after the first signal: the second one kills.
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (const int signal : kSignals) {
        struct sigaction before = {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
    }
}

StopOnSignal::~StopOnSignal() {
    for (const int signal : kSignals) {
        struct sigaction now = {};
        sigaction(signal, nullptr, &now);
        if (now.sa_handler == ask_to_stop) std::signal(signal, SIG_DFL);
    }
    running = nullptr;
}

}  // namespace asperity::cli
