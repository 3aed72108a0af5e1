/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Hands the files of the corpora to a target, as libFuzzer would: replay FOLDER-OR-FILE...
 * replay --words FOLDER-OR-FILE...: hands them over with one word after the other removed, doubled and replaced by words
 * that belong elsewhere. A word is a run of letters, digits and the signs of numbers, or any other character. To take
 * seconds, a run leaves out the inputs that a fuzzer found (their names are hashes), and of files with many words it takes
 * every second, third, ... one.
 */
#include <ctype.h>
#include <dirent.h>
#include <limits.h>
#include <stdio.h>

#include "target.h"

enum { MAX_FILE = 1 << 20, MAX_WORDS = 30, LONGEST_WORD = 16, HASH = 40 };

static uint8_t file[MAX_FILE];
static size_t file_size;

/* Hands over the file with the bytes from `begin` to `end` replaced by `text`. */
static void hand_over(size_t begin, size_t end, const char *text, size_t length)
{
    const size_t size = file_size - (end - begin) + length;
    uint8_t *bytes = malloc(size ? size : 1); /* of the exact size, so that AddressSanitizer sees its end */
    if (!bytes) {
        return;
    }
    memcpy(bytes, file, begin);
    memcpy(bytes + begin, text, length);
    memcpy(bytes + begin + length, file + end, file_size - end);
    LLVMFuzzerTestOneInput(bytes, size);
    free(bytes);
}

static bool in_word(size_t at)
{
    return at < file_size && (isalnum(file[at]) || (file[at] && strchr("+-._", file[at])));
}

/* The word at or after `at`; its end is *end, which is 0 at the end of the file. */
static size_t next_word(size_t at, size_t *end)
{
    while (at < file_size && isspace(file[at])) {
        at++;
    }
    *end = at;
    while (in_word(*end)) {
        ++*end;
    }
    *end = *end == at ? at + 1 : *end;
    *end = at < file_size ? *end : 0;
    return at;
}

static int damage_words(void)
{
    static const char *const others[] = {"",    "0",    "-1",   "0.5", "1e300", "-1e300", "99999999999",
                                         "nan", "x",    "\"\"", "\"x", "[]",    "{}",     "null",
                                         "\n",  "\xff", "%s",   "<a>", "/>",    "true"};
    size_t end, words = 0, n = 0;
    int count = 0;
    for (next_word(0, &end); end; next_word(end, &end)) {
        words++;
    }
    const size_t step = words / MAX_WORDS + 1;
    for (size_t at = next_word(0, &end); end; at = next_word(end, &end)) {
        if (n++ % step) {
            continue;
        }
        for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
            hand_over(at, end, others[i], strlen(others[i]));
        }
        hand_over(at, at, (const char *)file + at, end - at < LONGEST_WORD ? end - at : LONGEST_WORD);
        count++;
    }
    return count;
}

static int replay(const char *path, bool words)
{
    FILE *stream = fopen(path, "rb");
    if (!stream) {
        return 0;
    }
    file_size = fread(file, 1, sizeof file, stream);
    fclose(stream);
    if (words) {
        return damage_words();
    }
    hand_over(0, 0, "", 0);
    return 1;
}

int main(int argc, char **argv)
{
    const bool words = argc > 1 && !strcmp(argv[1], "--words");
    int count = 0;
    for (int i = 1 + words; i < argc; i++) {
        DIR *folder = opendir(argv[i]);
        if (!folder) {
            count += replay(argv[i], words);
            continue;
        }
        for (struct dirent *entry; (entry = readdir(folder));) {
            char path[PATH_MAX];
            snprintf(path, sizeof path, "%s/%s", argv[i], entry->d_name);
            if (entry->d_name[0] != '.' && !(words && strlen(entry->d_name) == HASH)) {
                count += replay(path, words);
            }
        }
        closedir(folder);
    }
    printf("%d %s\n", count, words ? "words" : "inputs");
    return count == 0;
}
