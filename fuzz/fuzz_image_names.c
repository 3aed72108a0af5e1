/* SPDX-License-Identifier: Apache-2.0 */
/* The first line is a path with places, the second a path that may fit. */
#include "study/images/images.h"
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    char pattern[1200], *text = malloc(size + 1);
    koksma__image_name name;
    bool fits;
    if (!text) {
        return 0;
    }
    memcpy(text, bytes, size);
    text[size] = '\0';
    char *path = strchr(text, '\n');
    if (path) {
        *path++ = '\0';
        const koksma_status status = koksma__image_names_pattern(text, pattern, sizeof pattern);
        fuzz_check_status(status);
        if (!status) {
            fuzz_check_status(koksma__image_name_read(text, path, &name, &fits));
        }
    }
    free(text);
    return 0;
}
