/* SPDX-License-Identifier: Apache-2.0 */
/* Readers: src/study/store */
/*
 * Damaged databases of studies. The input is a list of places and bytes that are put there: 3 bytes of offset, one of
 * length, the bytes; the end cuts the file off when the offset is its last. What is left is exported, reported and
 * run.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <koksma/study.h>

#include "target.h"

static const char plan[] =
    "{\"name\": \"f\", \"title\": \"f\", \"discrepancies\": [{\"id\": \"d\", \"patterns\": "
    "[\"random\", \"n-rooks\"], \"measures\": [\"star\", \"l2-star\", \"extreme\"], \"n\": [1, 4], "
    "\"trials\": 30}], \"questions\": [{\"id\": \"e\", \"kind\": \"table\", \"title\": \"t\", "
    "\"discrepancies\": \"d\"}]}";

static char folder[64], database[80], plan_path[80];
static unsigned char *sound;
static size_t sound_size;

static void clean_up(void)
{
    static const char *const names[] = {"plan.json",          "results.sqlite",         "results.sqlite-wal",
                                        "results.sqlite-shm", "results.sqlite-journal", "report.html",
                                        "references"};
    char path[96];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        remove(path);
    }
    rmdir(folder);
}

static bool a_while(void *context, double fraction)
{
    int *looks = context;
    (void)fraction;
    return ++*looks < 100000;
}

static void run_study(bool with_plan)
{
    int looks = 0;
    const char *const plans[] = {plan_path};
    const koksma_study_options options = {.plans = plans, .n_plans = with_plan, .folder = folder};
    const koksma_run run = {.threads = 1, .time_limit_s = 0.5, .keep_going = a_while, .context = &looks};
    koksma_study *study = NULL;
    koksma_status status = koksma_study_open(&options, &study);
    fuzz_check_status(status);
    if (!status) {
        fuzz_check_status(koksma_study_run(study, &run, NULL));
        fuzz_check_status(koksma_study_report(study, &run));
    }
    fuzz_check_status(koksma_study_close(study));
}

static void make_sound(void)
{
    snprintf(folder, sizeof folder, "%s/koksma-fuzz-store-XXXXXX", fuzz_place());
    if (!mkdtemp(folder)) {
        abort();
    }
    atexit(clean_up);
    snprintf(database, sizeof database, "%s/results.sqlite", folder);
    snprintf(plan_path, sizeof plan_path, "%s/plan.json", folder);
    FILE *f = fopen(plan_path, "w");
    if (!f || fputs(plan, f) < 0 || fclose(f)) {
        abort();
    }
    run_study(true);
    struct stat about;
    f = fopen(database, "rb");
    if (!f || fstat(fileno(f), &about) || !(sound = malloc((size_t)about.st_size))) {
        abort();
    }
    sound_size = fread(sound, 1, (size_t)about.st_size, f);
    fclose(f);
}

static size_t damage(unsigned char *to, const uint8_t *bytes, size_t size)
{
    memcpy(to, sound, sound_size);
    size_t left = sound_size;
    for (size_t i = 0; i + 4 <= size;) {
        const size_t offset = (bytes[i] | (size_t)bytes[i + 1] << 8 | (size_t)bytes[i + 2] << 16) % (sound_size + 1);
        size_t length = bytes[i + 3];
        i += 4;
        length = length < size - i ? length : size - i;
        if (length == 0) {
            left = offset;
        }
        length = length < sound_size - offset ? length : sound_size - offset;
        memcpy(to + offset, bytes + i, length);
        i += length;
    }
    return left;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (!sound) {
        make_sound();
    }
    unsigned char *damaged = malloc(sound_size);
    if (!damaged) {
        return 0;
    }
    const size_t left = damage(damaged, bytes, size);
    for (int what = 0; what < 3; what++) {
        char side[96];
        snprintf(side, sizeof side, "%s-wal", database);
        remove(side);
        snprintf(side, sizeof side, "%s-journal", database);
        remove(side);
        FILE *f = fopen(database, "wb");
        if (!f || fwrite(damaged, 1, left, f) != left || fclose(f)) {
            abort();
        }
        if (what == 0) {
            fuzz_check_status(koksma_study_export(folder, KOKSMA_EXPORT_CSV, "/dev/null"));
        } else {
            run_study(what == 1);
        }
    }
    free(damaged);
    return 0;
}
