/* SPDX-License-Identifier: Apache-2.0 */
/* The files of lattice-file and net-file: any bytes give points in [0, 1) or an error. */
#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static const char *const patterns[] = {"lattice-file", "net-file"};
    char path[64], text[80];
    snprintf(path, sizeof path, "%s/koksma-fuzz-%ld.txt", fuzz_place(), (long)getpid());
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (descriptor < 0 || write(descriptor, bytes, size) != (ssize_t)size || close(descriptor)) {
        abort();
    }
    for (size_t i = 0; i < 4; i++) {
        double xs[64];
        koksma_points points = {i / 2 ? 32 : 1, 2, xs};
        koksma_spec spec;
        snprintf(text, sizeof text, "%s:%s", patterns[i % 2], path);
        koksma_status status = koksma_pattern_spec(text, &spec);
        status = status ? status : koksma_generate(&spec, 0, NULL, &points);
        fuzz_check_status(status);
        for (size_t c = 0; !status && c < points.n * 2; c++) {
            if (!(xs[c] >= 0 && xs[c] < 1)) {
                abort();
            }
        }
    }
    unlink(path);
    return 0;
}
