/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_STATUS_H
#define KOKSMA_CORE_STATUS_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Stores the text for koksma_error_text() and returns status, so that a failing function ends with `return
   koksma__fail(KOKSMA_N, "jittered: …", …);`. koksma_text_escape() makes the text one line of UTF-8. */
KOKSMA__LAB koksma_status koksma__fail(koksma_status status, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* Returns the number of bytes of the UTF-8 character (RFC 3629) at the start of the text; 0 if the bytes are not
   valid UTF-8. */
size_t koksma__utf8_length(const unsigned char *text);

/* Sets the error text for a block of `bytes` that malloc or realloc could not allocate, and returns MEMORY. */
KOKSMA__LAB koksma_status koksma__fail_memory(size_t bytes);

/* Every function that a caller or a table provides, and that returns a status, is called as
       const char kept = koksma__call_begin();
       status = koksma__call_end(kept, f(...), "koksma_measure.eval");
   koksma__call_end makes sure that the status exists and that an error has a text, which names the function unless the
   function itself has set one; a number that is no status becomes ARGUMENT. Without an error the text is as before. */
KOKSMA__LAB char koksma__call_begin(void);
KOKSMA__LAB koksma_status koksma__call_end(char kept, koksma_status status, const char *function);

/* Puts a name in front of the text of the last failure ("PATH: reason") and returns status. */
KOKSMA__LAB koksma_status koksma__fail_in(koksma_status status, const char *name);

/* koksma__refused marks the last failure as one of a limit: the file may be sound, but takes more than the program
   allows. It returns status. A model loses a texture that is damaged with a warning; one that is refused is an error.
   koksma__fail removes the mark, koksma__fail_in keeps it. */
KOKSMA__LAB koksma_status koksma__refused(koksma_status status);
KOKSMA__LAB bool koksma__is_refused(void);

/* The checks that a public function begins with: KOKSMA__REQUIRE(points, out) returns ARGUMENT and names the first
   NULL pointer in the error text; KOKSMA__REQUIRE_OR(result, ...) returns `result` instead; in a void function write
   KOKSMA__REQUIRE_OR(, text); KOKSMA__REQUIRE_RUN(run) accepts NULL, or a run whose values are in range. */
#define KOKSMA__REQUIRE_OR(result, ...)                                                                              \
    do {                                                                                                             \
        const void *const required_[] = {__VA_ARGS__};                                                               \
        if (koksma__missing(__func__, #__VA_ARGS__, required_, sizeof required_ / sizeof *required_)) {              \
            return result;                                                                                           \
        }                                                                                                            \
    } while (0)
#define KOKSMA__REQUIRE(...) KOKSMA__REQUIRE_OR(KOKSMA_ARGUMENT, __VA_ARGS__)
#define KOKSMA__REQUIRE_RUN(run) KOKSMA__TRY(koksma__run_check(__func__, run))

/* Macros that end a function early with a status. KOKSMA__TRY(call) returns the status of a call that failed;
   KOKSMA__FAIL_IF(condition, status, format, ...) returns koksma__fail(status, format, ...);
   KOKSMA__REQUIRE_MEMORY(pointer, bytes) fails if the pointer from malloc is NULL. These macros free nothing: the
   function must not hold memory when it uses them. */
#define KOKSMA__TRY(call)                                                                                            \
    do {                                                                                                             \
        const koksma_status failed_ = (call);                                                                        \
        if (failed_) {                                                                                               \
            return failed_;                                                                                          \
        }                                                                                                            \
    } while (0)
#define KOKSMA__FAIL_IF(condition, ...)                                                                              \
    do {                                                                                                             \
        if (condition) {                                                                                             \
            return koksma__fail(__VA_ARGS__);                                                                        \
        }                                                                                                            \
    } while (0)
#define KOKSMA__REQUIRE_MEMORY(pointer, bytes)                                                                       \
    do {                                                                                                             \
        if (!(pointer)) {                                                                                            \
            return koksma__fail_memory(bytes);                                                                       \
        }                                                                                                            \
    } while (0)

/* Returns whether one of n pointers is NULL; the error text then names it. `names` holds the pointers' names,
   separated by commas. */
KOKSMA__LAB bool koksma__missing(const char *function, const char *names, const void *const *pointers, size_t n);

/* Checks an array of n items of a given size: `array` must not be NULL, unless n is 0, and its size in bytes must fit
   into size_t. `what` names the array in messages. Errors: ARGUMENT. */
KOKSMA__LAB koksma_status koksma__array_check(const char *what, const void *array, size_t n, size_t bytes);

/* Checks the members of a run. Errors: ARGUMENT (a negative number of threads, a time limit that is negative or
   NaN). */
KOKSMA__LAB koksma_status koksma__run_check(const char *function, const koksma_run *run);

#endif
