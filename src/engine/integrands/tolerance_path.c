/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The file of an integration to a tolerance: a head of lines that say which search it is, for each step a line with the
 * number of values so far, the least and the largest of them and the mean of each set, and a line with the compensated
 * sums of the sets after the last step, total and lost part. Numbers have 17 digits, which give their bits back.
 *
 *     koksma integral 1
 *     function exp
 *     pattern sobol:scramble=lms,digital-shift=1
 *     dim 2, seed 0, 9 parts with check, first n 64
 *     first value 1.7
 *     step 512 1.1 7.3 2.95 2.96 ..
 *     sums 188.9 0 189.1 -1e-15 ..
 */
#include "integrands/tolerance_path.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/c_locale.h"
#include "core/files.h"
#include "core/status.h"

void koksma__search_head(koksma__search *path, const char *function, const char *pattern, int dim, uint64_t seed,
                         bool parts, double first)
{
    char line[KOKSMA_MAX_SPEC];
    snprintf(line, sizeof line, "%s", function);
    for (char *c = line; *c; c++) {
        *c = *c == '\n' || *c == '\r' ? ' ' : *c;
    }
    koksma__snprintf(
        path->head, sizeof path->head,
        "koksma integral 1\nfunction %s\npattern %s\ndim %d, seed %llu, %zu %s, first n %zu\nfirst value "
        "%.17g\n",
        line, pattern, dim, (unsigned long long)seed, path->sets, parts ? "parts with check" : "sets", path->first_n,
        first);
}

/* Fails with the first line in which a head differs. */
static koksma_status compare(const char *file, const char *text, const char *head)
{
    for (int line = 1; *head; line++) {
        const size_t length = strcspn(head, "\n"), other = strcspn(text, "\n");
        KOKSMA__FAIL_IF(line == 1 && (other != length || memcmp(text, head, length) != 0), KOKSMA_MALFORMED,
                        "%s:1: it is no file of an integration to a tolerance; another name begins one", file);
        KOKSMA__FAIL_IF(other != length || memcmp(text, head, length) != 0, KOKSMA_ARGUMENT,
                        "%s:%d: the search in this file has '%.*s' in place of '%.*s'; another name begins a new one",
                        file, line, (int)(other < 200 ? other : 200), text, (int)length, head);
        head += length + 1;
        text += other + (text[other] == '\n');
    }
    return KOKSMA_OK;
}

/* Reads a number, which a blank precedes, and moves on. */
static bool take(const char **text, double *number)
{
    char *end;
    if (**text != ' ') {
        return false;
    }
    *number = koksma__strtod(*text + 1, &end);
    const bool good = end > *text + 1 && isfinite(*number);
    *text = end;
    return good;
}

static bool take_word(const char **text, const char *word)
{
    const size_t length = strlen(word);
    const bool found = !strncmp(*text, word, length);
    *text += found ? length : 0;
    return found;
}

static koksma_status read_step(koksma__search *path, const char **text, bool *good)
{
    koksma__search_step *step = &path->steps[path->n_steps];
    double points = 0;
    step->means = malloc(path->sets * sizeof *step->means);
    KOKSMA__REQUIRE_MEMORY(step->means, path->sets * sizeof *step->means);
    path->n_steps++;
    *good = take(text, &points) && points >= 1 && points < 0x1p53 && take(text, &step->least) &&
            take(text, &step->largest);
    step->points = *good ? (uint64_t)points : 0;
    for (size_t r = 0; r < path->sets && *good; r++) {
        *good = take(text, &step->means[r]);
    }
    *good = *good && take_word(text, "\n");
    return KOKSMA_OK;
}

static koksma_status read_steps(const char *file, koksma__search *path, const char *text)
{
    bool good = true;
    while (good && path->n_steps < KOKSMA_MAX_STEPS && take_word(&text, "step")) {
        KOKSMA__TRY(read_step(path, &text, &good));
    }
    good = good && path->n_steps && take_word(&text, "sums");
    for (size_t r = 0; r < path->sets && good; r++) {
        good = take(&text, &path->sums[r].total) && take(&text, &path->sums[r].lost);
    }
    KOKSMA__FAIL_IF(!good || strcmp(text, "\n") != 0, KOKSMA_MALFORMED,
                    "%s: its steps are damaged; another name begins a new search", file);
    return KOKSMA_OK;
}

koksma_status koksma__search_read(const char *file, koksma__search *path)
{
    unsigned char *bytes;
    size_t size;
    struct stat info;
    if (stat(file, &info)) { /* there is none, or koksma__search_write will say what is wrong */
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__read_file(file, KOKSMA__FILE_PARAMETERS, KOKSMA__BY_FILE, koksma__check_text, &bytes, &size));
    koksma_status status = compare(file, (const char *)bytes, path->head);
    status = status ? status : read_steps(file, path, (const char *)bytes + strlen(path->head));
    free(bytes);
    return status;
}

static void put(FILE *stream, double number)
{
    char text[KOKSMA__CSV_NUMBER];
    fputc(' ', stream);
    fwrite(text, 1, koksma__csv_number(number, text), stream);
}

koksma_status koksma__search_write(const char *file, const koksma__search *path)
{
    koksma__atomic_file out;
    KOKSMA__TRY(koksma__atomic_open(NULL, file, &out));
    fputs(path->head, out.stream);
    for (size_t k = 0; k < path->n_steps; k++) {
        const koksma__search_step *step = &path->steps[k];
        fputs("step", out.stream);
        put(out.stream, (double)step->points);
        put(out.stream, step->least);
        put(out.stream, step->largest);
        for (size_t r = 0; r < path->sets; r++) {
            put(out.stream, step->means[r]);
        }
        fputc('\n', out.stream);
    }
    fputs("sums", out.stream);
    for (size_t r = 0; r < path->sets; r++) {
        put(out.stream, path->sums[r].total);
        put(out.stream, path->sums[r].lost);
    }
    fputc('\n', out.stream);
    return koksma__atomic_close(&out, true);
}

void koksma__search_fini(koksma__search *path)
{
    for (size_t k = 0; k < path->n_steps; k++) {
        free(path->steps[k].means);
    }
    free(path->sums);
}
