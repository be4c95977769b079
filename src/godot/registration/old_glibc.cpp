// SPDX-License-Identifier: MIT
// Lets a library that was linked with a new glibc load with glibc 2.28, as Godot's own builds do.
//
// A linker binds a function to the newest version that the glibc of the building machine has. Functions that moved into another
// library (pthread_once, 2.34) or got another way to report errors (log, 2.29) then ask for that glibc, although the old
// version is still there and does the same. Each function below has the name that the compiler and the static C++ library call,
// is seen inside of this library alone, and calls
// the old version. What old versions of glibc do not have at all is defined
// here. scripts/test.sh looks at the versions that the library asks for. Godot builds itself with glibc 2.28.
#if defined(__linux__) && !defined(__ANDROID__)
#include <features.h>
#endif

#if defined(__GLIBC__) && (defined(__x86_64__) || defined(__aarch64__)) && !defined(__SANITIZE_ADDRESS__)

#ifdef __x86_64__
#define OLDEST_GLIBC "GLIBC_2.2.5"
#else
#define OLDEST_GLIBC "GLIBC_2.17"
#endif

#define HERE_ALONE __attribute__((visibility("hidden"), used))

// A function that the linker knows as `name`, and `old_name` for the version of it that every glibc has. For the compiler it has
// another name, as it lets nobody hide the functions of mathematics that it knows.
#define WITH_OLD_VERSION(result, name, parameters, arguments)             \
	extern result old_##name parameters;                                  \
	__asm__(".symver old_" #name "," #name "@" OLDEST_GLIBC);             \
	HERE_ALONE result own_##name parameters __asm__(#name);               \
	HERE_ALONE result own_##name parameters { return old_##name arguments; }

// No header of glibc or of C++ is included that declares these names, as what they declare could be seen from outside.
extern "C" {

using Once = int; // pthread_once_t
using Key = unsigned; // pthread_key_t

#if __GLIBC_PREREQ(2, 34)
WITH_OLD_VERSION(int, pthread_once, (Once * once, void (*function)()), (once, function))
WITH_OLD_VERSION(int, pthread_key_create, (Key * key, void (*at_end)(void *)), (key, at_end))
WITH_OLD_VERSION(int, pthread_key_delete, (Key key), (key))
WITH_OLD_VERSION(void *, pthread_getspecific, (Key key), (key))
WITH_OLD_VERSION(int, pthread_setspecific, (Key key, const void *value), (key, value))

// An old glibc has this name as well, but the static C++ library asks for it in the version of the new one.
HERE_ALONE int __pthread_key_create(Key *key, void (*at_end)(void *)) {
	return old_pthread_key_create(key, at_end);
}
#endif

#if __GLIBC_PREREQ(2, 29)
WITH_OLD_VERSION(double, exp, (double x), (x))
WITH_OLD_VERSION(double, log, (double x), (x))
WITH_OLD_VERSION(double, pow, (double x, double y), (x, y))
#endif

#if __GLIBC_PREREQ(2, 32)
// Counters of shared pointers ask whether there is but one thread. Godot has several.
HERE_ALONE char __libc_single_threaded = 0;
#endif

#if __GLIBC_PREREQ(2, 35)
WITH_OLD_VERSION(double, hypot, (double x, double y), (x, y))
#endif

#if __GLIBC_PREREQ(2, 36)
int getentropy(void *bytes, decltype(sizeof(0)) count); // since glibc 2.25

// What std::random_device of the static C++ library calls. Nothing here uses that class.
HERE_ALONE unsigned arc4random() {
	unsigned value = 0;
	if (getentropy(&value, sizeof(value)) != 0) {
		__builtin_trap();
	}
	return value;
}
#endif

} // extern "C"

#endif
