/* Whether the processor, and the system on it, have vectors of four doubles (AVX2): the library is built for these too. */

#include "kernel.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

KERNEL int64_t lpcal_wide(void) {
#if defined(__x86_64__)
    unsigned a, b, c, d, low, high;
    if (!__get_cpuid(1, &a, &b, &c, &d) || (c >> 27 & 3) != 3) return 0; /* OSXSAVE and AVX */
    __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return (low & 6) == 6 && __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b >> 5 & 1);
#else
    return 0;
#endif
}
