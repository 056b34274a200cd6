// SPDX-License-Identifier: Apache-2.0
#include "stop.h"

#include <atomic>
#include <csignal>

namespace asperity::cli {

namespace {

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
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

StopOnSignal::~StopOnSignal() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    running = nullptr;
}

}  // namespace asperity::cli
