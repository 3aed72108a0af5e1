/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_STATUS_H
#define KOKSMA_CORE_STATUS_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Keeps the text for koksma_error_text() and returns status, so that a failing function ends with
   `return koksma__fail(KOKSMA_N, "jittered: …", …);`. koksma_text_escape() makes
   the text one line of UTF-8. */
KOKSMA__LAB koksma_status koksma__fail(koksma_status status, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* The bytes of the UTF-8 character (RFC 3629) at the text's start; 0: there is none. */
size_t koksma__utf8_length(const unsigned char *text);

/* malloc's and realloc's failure, said in one place. */
KOKSMA__LAB koksma_status koksma__fail_memory(size_t bytes);

/* Puts a name in front of the text of the last failure ("PATH: reason") and returns status. */
KOKSMA__LAB koksma_status koksma__fail_in(koksma_status status, const char *name);

#endif
