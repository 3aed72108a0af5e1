/* SPDX-License-Identifier: Apache-2.0 */
/* Point sets with exact values: the files of this folder, and those of the folder that KOKSMA_VECTORS names when it
   is set. A file is lines "key value", where a key is a measure (or one of the short names below), then "points"
   and one point a line; # begins a comment. */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include "test.h"

static const struct {
    const char *key, *measure;
    double bound;
} short_names[] = {
    {"D", "star", 1e-12},
    {"S", "l2-star", 1e-12},
    {"T", "extreme", 1e-12},
    {"edge_linf", "edge", 1e-11},
    {"edge_l2_paper", "l2-edge:law=mitchell", 1e-11},
    {"edge_l2_iso", "l2-edge", 1e-11},
    {"disk_l2_r0.125", "l2-disk:r=0.125", 1e-11},
    {"disk_l2_r0.25", "l2-disk:r=0.25", 1e-11},
    {"disk_l2_r0.5", "l2-disk:r=0.5", 1e-11},
    {"disk_l2_runif", "l2-disk:law=radius", 1e-11},
    {"disk_l2_aunif", "l2-disk:law=area", 1e-11},
};

enum { MAX_VALUES = 64, MAX_LINE = 1024 };

typedef struct vector {
    koksma_points points;
    char keys[MAX_VALUES][64];
    double values[MAX_VALUES];
    size_t n_values;
} vector;

static vector read_vector(const char *path)
{
    vector v = {.n_values = 0};
    char line[MAX_LINE];
    size_t n = 0, filled = 0;
    int dim = 0;
    bool in_points = false;
    FILE *f = fopen(path, "r");
    if (!f) {
        fail_msg("can't open %s", path);
        return v;
    }
    while (fgets(line, sizeof line, f)) {
        char key[64];
        double value;
        if (line[0] == '#') {
            continue;
        }
        if (in_points) {
            const char *rest = line;
            for (int k = 0; k < dim && filled < n * (size_t)dim; k++) {
                char *end;
                v.points.xs[filled++] = strtod(rest, &end);
                rest = end;
            }
        } else if (!strncmp(line, "points", 6)) {
            in_points = true;
            assert_ok(koksma_points_init(&v.points, n, dim));
        } else if (sscanf(line, "%63s %lf", key, &value) == 2) {
            if (!strcmp(key, "dim")) {
                dim = (int)value;
            } else if (!strcmp(key, "n")) {
                n = (size_t)value;
            } else if (v.n_values < MAX_VALUES) {
                strcpy(v.keys[v.n_values], key);
                v.values[v.n_values++] = value;
            }
        }
    }
    fclose(f);
    if (!filled || filled != n * (size_t)dim) {
        fail_msg("%s: %zu numbers for %zu points of %d dimensions", path, filled, n, dim);
    }
    return v;
}

static void check_file(const char *path, bool strict)
{
    vector v = read_vector(path);
    for (size_t i = 0; i < v.n_values; i++) {
        const char *measure = strict ? v.keys[i] : NULL;
        double bound = 1e-11;
        for (size_t s = 0; s < sizeof short_names / sizeof *short_names; s++) {
            if (!strcmp(short_names[s].key, v.keys[i])) {
                measure = short_names[s].measure;
                bound = short_names[s].bound;
            }
        }
        if (measure) {
            const double ours = test_measure(measure, &v.points).value;
            if (!(fabs(ours - v.values[i]) <= bound)) {
                fail_msg("%s: %s is %.17g, and should be %.17g", path, measure, ours, v.values[i]);
            }
        }
    }
    koksma_points_fini(&v.points);
}

static int check_folder(const char *folder, bool strict)
{
    int files = 0;
    DIR *d = opendir(folder);
    if (!d) {
        fail_msg("can't open the folder %s", folder);
        return 0;
    }
    for (const struct dirent *e; (e = readdir(d));) {
        const size_t length = strlen(e->d_name);
        if (length > 4 && !strcmp(e->d_name + length - 4, ".txt")) {
            char path[2 * MAX_LINE];
            snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
            check_file(path, strict);
            files++;
        }
    }
    closedir(d);
    return files;
}

static void golden_values(void **state)
{
    (void)state;
    assert_true(check_folder(KOKSMA_TESTS "/golden", true) >= 10);
}

static void values_of_an_outside_folder(void **state)
{
    (void)state;
    const char *folder = getenv("KOKSMA_VECTORS");
    if (!folder || !*folder) {
        skip();
    }
    assert_true(check_folder(folder, false) > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(golden_values),
        cmocka_unit_test(values_of_an_outside_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
