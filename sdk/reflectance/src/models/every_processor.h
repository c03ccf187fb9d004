#pragma once
// Compiles a function for three instruction sets, of which the program takes the widest that the
// processor has, with all that it calls inlined. The sanitizers start after the choice would be
// made.

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__)
#define TSUYA_FOR_EVERY_PROCESSOR                                                                  \
    __attribute__((flatten, target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define TSUYA_FOR_EVERY_PROCESSOR __attribute__((flatten))
#endif
