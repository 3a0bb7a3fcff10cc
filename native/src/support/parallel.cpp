// Deterministic parallel loops on plain threads.
#include "support/parallel.h"

#include <algorithm>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

#include "support/profile.h"

namespace atlas_refine {

int resolve_threads(int requested) {
  if (requested > 0) return requested;
  return std::max(1u, std::thread::hardware_concurrency());
}

void parallel_ranges(int count, int threads, int grain, const std::function<void(int, int)>& body) {
  const int parts = std::min(threads, std::max(1, count / std::max(1, grain)));
  if (parts <= 1) {
    if (count > 0) body(0, count);
    return;
  }
  std::vector<std::exception_ptr> errors(parts);
  std::vector<Account> accounts(parts);  // of the workers
  const Phase phase = present_phase();
  const auto run = [&](int part) {
    const PhaseScope scope(phase);
    try {
      body(static_cast<int>(static_cast<long long>(count) * part / parts),
           static_cast<int>(static_cast<long long>(count) * (part + 1) / parts));
    } catch (...) {
      errors[part] = std::current_exception();
    }
  };
  int started = 1;
  {
    std::vector<std::jthread> workers;
    workers.reserve(parts - 1);
    const auto work = [&](int part) {
      run(part);
      accounts[part] = take_account();
    };
    try {
      for (; started < parts; ++started) workers.emplace_back(work, started);
    } catch (const std::system_error&) {
      // The system gives no more threads: the rest is for this one.
    }
    run(0);
    for (int part = started; part < parts; ++part) run(part);
  }
  for (const Account& account : accounts) account_for(account);
  for (const auto& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace atlas_refine
