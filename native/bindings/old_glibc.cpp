// Linked into a portable module: what glibc has in newer versions than 2.28 by names of older ones, so that the module loads there too.
// tests/install/test_portable.py looks at what is left.

#include <cerrno>
#include <ctime>

#include <pthread.h>

// clang-format off
#define FROM(version, function) __asm__(".symver old_" #function "," #function "@GLIBC_" version)
// clang-format on
#define HIDDEN __attribute__((visibility("hidden")))

FROM("2.2.5", exp);
FROM("2.2.5", log);
FROM("2.2.5", log2);
FROM("2.2.5", pow);
FROM("2.2.5", hypot);
FROM("2.3.2", pthread_cond_timedwait);

extern "C" {

double old_exp(double);
double old_log(double);
double old_log2(double);
double old_pow(double, double);
double old_hypot(double, double);
int old_pthread_cond_timedwait(pthread_cond_t*, pthread_mutex_t*, const timespec*);

// The newer versions differ in how they report errors alone, which nothing here reads.
HIDDEN double exp(double x) { return old_exp(x); }
HIDDEN double log(double x) { return old_log(x); }
HIDDEN double log2(double x) { return old_log2(x); }
HIDDEN double pow(double x, double y) { return old_pow(x, y); }
HIDDEN double hypot(double x, double y) { return old_hypot(x, y); }

// Since 2.32: whether reference counts may do without atomic operations. They may not.
HIDDEN char __libc_single_threaded = 0;  // NOLINT(bugprone-reserved-identifier): glibc's name

// Since 2.30, and what std::condition_variable waits by: here by the clock on the wall, as long as there is left by the other one.
HIDDEN int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock, const timespec* until) {
  constexpr long kSecond = 1'000'000'000;
  timespec now{}, wall{};
  clock_gettime(clock, &now);
  clock_gettime(CLOCK_REALTIME, &wall);
  const long nanoseconds = wall.tv_nsec + until->tv_nsec - now.tv_nsec + kSecond;  // 0 to 3 s
  const timespec end{wall.tv_sec + until->tv_sec - now.tv_sec - 1 + nanoseconds / kSecond, nanoseconds % kSecond};
  return old_pthread_cond_timedwait(condition, mutex, &end);
}

}  // extern "C"
