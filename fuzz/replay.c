/* SPDX-License-Identifier: Apache-2.0 */
/* Hands the files of the corpora to a target, as libFuzzer would: replay FOLDER-OR-FILE... */
#include <dirent.h>
#include <limits.h>
#include <stdio.h>

#include "target.h"

static int replay(const char *path)
{
    FILE *stream = fopen(path, "rb");
    static uint8_t room[1 << 20];
    if (!stream) {
        return 0;
    }
    const size_t size = fread(room, 1, sizeof room, stream);
    fclose(stream);
    uint8_t *bytes = malloc(size ? size : 1); /* of the exact size, so that AddressSanitizer sees its end */
    if (!bytes) {
        return 0;
    }
    memcpy(bytes, room, size);
    LLVMFuzzerTestOneInput(bytes, size);
    free(bytes);
    return 1;
}

int main(int argc, char **argv)
{
    int count = 0;
    for (int i = 1; i < argc; i++) {
        DIR *folder = opendir(argv[i]);
        if (!folder) {
            count += replay(argv[i]);
            continue;
        }
        for (struct dirent *entry; (entry = readdir(folder));) {
            char path[PATH_MAX];
            snprintf(path, sizeof path, "%s/%s", argv[i], entry->d_name);
            count += entry->d_name[0] != '.' ? replay(path) : 0;
        }
        closedir(folder);
    }
    printf("%d inputs\n", count);
    return count == 0;
}
