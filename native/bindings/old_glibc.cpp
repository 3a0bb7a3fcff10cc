// Linked into a portable module: by names of older versions what glibc has in newer ones than 2.28, so that the module loads
// there too. module.map keeps it to the module; tools/check_portable.py says what is left.

#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ctime>

/// Declares old_NAME, which is NAME as glibc had it from that version on.
#define OLD(version, result, name, ...)                      \
  __asm__(".symver old_" #name "," #name "@GLIBC_" version); \
  extern "C" result old_##name(__VA_ARGS__);

OLD("2.2.5", double, exp, double)
OLD("2.2.5", double, log, double)
OLD("2.2.5", double, log2, double)
OLD("2.2.5", double, pow, double, double)
OLD("2.2.5", double, hypot, double, double)
OLD("2.2.5", int, __fxstat64, int, int, struct stat64*)
OLD("2.2.5", int, pthread_create, pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)
OLD("2.2.5", int, pthread_join, pthread_t, void**)
OLD("2.2.5", int, pthread_detach, pthread_t)
OLD("2.2.5", int, pthread_once, pthread_once_t*, void (*)())
OLD("2.2.5", int, pthread_key_create, pthread_key_t*, void (*)(void*))
OLD("2.2.5", int, pthread_key_delete, pthread_key_t)
OLD("2.2.5", int, pthread_setspecific, pthread_key_t, const void*)
OLD("2.2.5", void*, pthread_getspecific, pthread_key_t)
OLD("2.3.2", int, pthread_cond_timedwait, pthread_cond_t*, pthread_mutex_t*, const timespec*)

extern "C" {

// The newer versions differ in how they report errors alone, which nothing here reads.
double exp(double x) { return old_exp(x); }
double log(double x) { return old_log(x); }
double log2(double x) { return old_log2(x); }
double pow(double x, double y) { return old_pow(x, y); }
double hypot(double x, double y) { return old_hypot(x, y); }

// Until 2.33 under another name, with the number of the structure's version.
int fstat64(int file, struct stat64* status) noexcept { return old___fxstat64(1, file, status); }

// Until 2.34 in libpthread.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // of a value that is passed on, to what glibc says does not read it
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*), void* argument) noexcept {
  return old_pthread_create(thread, attributes, start, argument);
}
int pthread_join(pthread_t thread, void** result) { return old_pthread_join(thread, result); }
int pthread_detach(pthread_t thread) noexcept { return old_pthread_detach(thread); }
int pthread_once(pthread_once_t* once, void (*start)()) { return old_pthread_once(once, start); }
int pthread_key_create(pthread_key_t* key, void (*end)(void*)) noexcept { return old_pthread_key_create(key, end); }
// NOLINTNEXTLINE(bugprone-reserved-identifier): glibc's name
int __pthread_key_create(pthread_key_t* key, void (*end)(void*)) noexcept { return old_pthread_key_create(key, end); }
int pthread_key_delete(pthread_key_t key) noexcept { return old_pthread_key_delete(key); }
int pthread_setspecific(pthread_key_t key, const void* value) noexcept { return old_pthread_setspecific(key, value); }
void* pthread_getspecific(pthread_key_t key) noexcept { return old_pthread_getspecific(key); }

// Since 2.36; std::random_device has it.
unsigned arc4random() noexcept {
  unsigned value = 0;
  if (getentropy(&value, sizeof value) != 0) __builtin_trap();
  return value;
}

// Since 2.32: whether reference counts may do without atomic operations. They may not.
char __libc_single_threaded = 0;  // NOLINT(bugprone-reserved-identifier): glibc's name

// Since 2.30, for std::condition_variable: here by the clock on the wall, for as long as is left by the other one.
int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock, const timespec* until) {
  constexpr long kSecond = 1'000'000'000;
  timespec now{}, wall{};
  clock_gettime(clock, &now);
  clock_gettime(CLOCK_REALTIME, &wall);
  const long nanoseconds = wall.tv_nsec + until->tv_nsec - now.tv_nsec + kSecond;  // from 0 to 3 s
  const timespec end{wall.tv_sec + until->tv_sec - now.tv_sec - 1 + nanoseconds / kSecond, nanoseconds % kSecond};
  return old_pthread_cond_timedwait(condition, mutex, &end);
}

}  // extern "C"
