// Compiles functions for several generations of x86 processors. Internal to the library: no installed header includes
// this one.
//
// The dynamic linker chooses a version when the program starts. All of them give the same bits, because contraction to
// fused multiply-adds is off (-ffp-contract=off). What such a function calls must be inlined to profit.
#pragma once

#if __has_include(<features.h>)
#include <features.h>  // defines __GLIBC__
#endif

// PLANET_CPU_CLONES, before the definition of a function, compiles it for processors with AVX-512 (x86-64-v4), with AVX2
// (x86-64-v3) and for any other. It is empty where the linker cannot choose, and with sanitizers, which are not ready yet
// when it does. The levels are named rather than the extensions: for "avx512f" alone, GCC 12 leaves out some vzeroupper
// instructions, and then code for SSE runs at half its speed.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#if __GNUC__ >= 12
#define PLANET_CPU_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
#endif
#ifndef PLANET_CPU_CLONES
#define PLANET_CPU_CLONES
#endif

// Before an inline function that clones call.
#define PLANET_ALWAYS_INLINE inline __attribute__((always_inline))
