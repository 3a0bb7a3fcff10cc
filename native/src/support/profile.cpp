// Each thread's account, by its own clock.
#include "support/profile.h"

#include <ctime>
#include <utility>

namespace atlas_refine {
namespace {

double thread_seconds() {
  timespec time = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Present {
  Account account;
  Phase phase = Phase::Other;
  double since = thread_seconds();

  void settle() {
    const double now = thread_seconds();
    account.seconds[static_cast<int>(phase)] += now - std::exchange(since, now);
  }
  Phase enter(Phase next) {
    settle();
    return std::exchange(phase, next);
  }
};

thread_local Present present;

}  // namespace

const char* to_string(Phase phase) {
  static constexpr std::array<const char*, kPhases> kNames = {"input",       "pack",        "align",  "layout", "coarsen",
                                                              "assemble",    "order",       "factor", "solve",  "contacts",
                                                              "line_search", "certificate", "other"};
  return kNames[static_cast<int>(phase)];
}

Account& Account::operator+=(const Account& other) {
  for (int k = 0; k < kPhases; ++k) seconds[k] += other.seconds[k];
  steps += other.steps;
  fractions += other.fractions;
  return *this;
}

PhaseScope::PhaseScope(Phase phase) : outer_(present.enter(phase)) {}
PhaseScope::~PhaseScope() { present.enter(outer_); }

Phase present_phase() { return present.phase; }

void account_step(double fraction) {
  ++present.account.steps;
  present.account.fractions += fraction;
}

void account_for(const Account& others) { present.account += others; }

Account take_account() {
  present.settle();
  return std::exchange(present.account, {});
}

}  // namespace atlas_refine
