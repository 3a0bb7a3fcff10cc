// Parts are claimed one by one under one mutex: they are to be long against that.
#include "support/thread_pool.h"

#include <exception>
#include <system_error>

#include "support/profile.h"

namespace atlas_refine {
namespace {

thread_local ThreadPool* present_pool = nullptr;

}  // namespace

/// One call of run, on the stack of the thread that made it.
struct ThreadPool::Call {
  const std::function<void(int)>& body;
  int parts;
  int most_helpers;
  Phase phase = present_phase();
  int next = 0;
  int helping = 0;
  int failed_part = -1;
  std::exception_ptr error = nullptr;
  Account account = {};  // of those that help
};

ThreadPool* ThreadPool::present() { return present_pool; }
void ThreadPool::set_present(ThreadPool* pool) { present_pool = pool; }

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  called_.notify_all();
}

void ThreadPool::run(int parts, int helpers, const std::function<void(int)>& body) {
  Call call{.body = body, .parts = parts, .most_helpers = helpers};
  std::unique_lock lock(mutex_);
  start_helpers();
  calls_.push_back(&call);
  called_.notify_all();
  take_parts(call, lock);
  std::erase(calls_, &call);
  ended_.wait(lock, [&] { return call.helping == 0; });
  lock.unlock();
  account_for(call.account);
  if (call.error) std::rethrow_exception(call.error);
}

void ThreadPool::start_helpers() {
  try {
    while (static_cast<int>(helpers_.size()) < most_helpers_) helpers_.emplace_back([this] { help(); });
  } catch (const std::system_error&) {
    most_helpers_ = static_cast<int>(helpers_.size());  // the system gives no more threads
  }
}

ThreadPool::Call* ThreadPool::open_call() const {
  for (auto call = calls_.rbegin(); call != calls_.rend(); ++call) {
    if ((*call)->next < (*call)->parts && (*call)->helping < (*call)->most_helpers) return *call;
  }
  return nullptr;
}

void ThreadPool::help() {
  set_present(this);
  std::unique_lock lock(mutex_);
  while (true) {
    Call* call = nullptr;
    called_.wait(lock, [&] { return (call = open_call()) || closing_; });
    if (!call) return;
    ++call->helping;
    {
      const PhaseScope scope(call->phase);
      take_parts(*call, lock);
    }
    call->account += take_account();
    --call->helping;
    ended_.notify_all();
  }
}

void ThreadPool::take_parts(Call& call, std::unique_lock<std::mutex>& lock) {
  while (call.next < call.parts) {
    const int part = call.next++;
    lock.unlock();
    std::exception_ptr error;
    try {
      call.body(part);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    if (!error) continue;
    call.next = call.parts;
    if (call.failed_part >= 0 && call.failed_part < part) continue;
    call.failed_part = part;
    call.error = std::move(error);
  }
}

ThreadPoolScope::ThreadPoolScope(int threads) : outer_(ThreadPool::present()), own_(threads - 1) {
  if (!outer_) ThreadPool::set_present(&own_);
}

ThreadPoolScope::~ThreadPoolScope() { ThreadPool::set_present(outer_); }

}  // namespace atlas_refine
