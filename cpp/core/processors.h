#pragma once

// Functions that go for several numbers at once are compiled for the processors of today and for any, and
// each machine takes the best that it can (GCC's ifunc). CMakeLists.txt forbids a * b + c in one rounding
// where this is used, so that all of them give the same bits. Not with ThreadSanitizer: the choice is made
// before it is ready.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define SKEIN_FOR_EACH_PROCESSOR __attribute__((target_clones("avx512f", "avx2", "default")))
/// Before a loop: what one turn of it writes, no other one reads.
#define SKEIN_EACH_BY_ITSELF _Pragma("GCC ivdep")
#else
#define SKEIN_FOR_EACH_PROCESSOR
#define SKEIN_EACH_BY_ITSELF
#endif
