/* SPDX-License-Identifier: Apache-2.0 */
/* How a printed mean goes with ours: every verdict, z with half of the last printed digit, slopes of printed means. */
#include "study/report/report.h"

#include <math.h>

#include "test.h"

static koksma__cell cell_of(double mean, double sd, size_t n)
{
    return (koksma__cell){.mean = {.n = n, .mean = mean, .sd = sd, .low = mean, .high = mean}, .sd = sd};
}

static char pattern[] = "random", measure[] = "star", scene[] = "checker";

/* A table of a measure with one row and, for `explained` 0 or 1, a note on its mean. */
typedef struct one_row {
    koksma__table table;
    koksma__table_row row;
    koksma__note note;
    long long n[3];
} one_row;

static void set_up(one_row *t, double value, double half_digit, int explained)
{
    *t = (one_row){.n = {16, 256, 1600}};
    t->row = (koksma__table_row){.pattern = pattern, .label = pattern, .n_published = 1};
    for (int i = 0; i < 3; i++) {
        t->row.published[i] = (koksma__printed){.value = i ? (double)NAN : value, .half_digit = half_digit};
    }
    t->note = (koksma__note){.pattern = pattern, .explained = explained == 1};
    t->table = (koksma__table){.measure = measure,
                               .n = {1, t->n},
                               .n_rows = 1,
                               .rows = &t->row,
                               .n_notes = explained >= 0,
                               .notes = &t->note};
}

/* Printed 0.282 of 100 sets; ours 0.29 of 400 sets with SD 0.05: the standard error of the difference is
   0.05 sqrt(1/100 + 1/400) = 0.0055902, rounding adds 0.0005, and z = -0.008 / 0.0060902 = -1.3136. */
TEST_CASE(z_has_both_errors_and_the_rounding)
{
    one_row t;
    set_up(&t, 0.282, 0.0005, -1);
    const koksma__cell cell = cell_of(0.29, 0.05, 400);
    assert_near(koksma__table_judge(&t.table, &t.row, 0, &cell).z, -1.3136, 1e-4);
}

enum { NONE = -1, NOT_EXPLAINED, IS_EXPLAINED, UNTESTED };

/* A note does not hide agreement, unless it says that there is nothing to agree with; a dark scene has no error. */
TEST_CASE(every_verdict_has_its_case)
{
    static const struct {
        double printed, half_digit;
        int note;
        bool in_scene, fitted;
        double mean, sd;
        size_t n;
        koksma_study_verdict verdict;
    } cases[] = {{0.282, 0.0005, NONE, false, false, 0.29, 0.05, 400, KOKSMA_VERDICT_AGREES},
                 {0.282, 0.0005, NONE, false, false, 0.31, 0.05, 400, KOKSMA_VERDICT_UNEXPLAINED},
                 {0.282, 0.0005, NONE, false, false, 0.29, NAN, 1, KOKSMA_VERDICT_WAITING},
                 {0.282, 0.0005, NONE, false, false, NAN, NAN, 0, KOKSMA_VERDICT_WAITING},
                 {0.282, 0.0005, IS_EXPLAINED, false, false, 0.31, 0.05, 400, KOKSMA_VERDICT_EXPLAINED},
                 {0.282, 0.0005, IS_EXPLAINED, false, false, 0.29, 0.05, 400, KOKSMA_VERDICT_AGREES},
                 {0.282, 0.0005, UNTESTED, false, false, 0.29, 0.05, 400, KOKSMA_VERDICT_UNTESTED},
                 {0.282, 0.0005, UNTESTED, false, false, 0.31, 0.05, 400, KOKSMA_VERDICT_UNTESTED},
                 {0.282, 0.0005, NOT_EXPLAINED, false, false, 0.31, 0.05, 400, KOKSMA_VERDICT_UNEXPLAINED},
                 {NAN, 0, IS_EXPLAINED, false, false, 0.31, 0.05, 400, KOKSMA_VERDICT_NEW},
                 {0.02, 0.0005, NONE, true, false, 0.0249, 0.05, 3, KOKSMA_VERDICT_AGREES},
                 {0.02, 0.0005, NONE, true, false, 0.0251, 0.05, 3, KOKSMA_VERDICT_UNEXPLAINED},
                 {0, 0.0005, NONE, true, false, 0, 0, 3, KOKSMA_VERDICT_AGREES},
                 {0, 0.0005, NONE, true, false, 0.001, 0, 3, KOKSMA_VERDICT_UNEXPLAINED},
                 {0.02, 0.0005, NONE, true, true, 0.0249, 0.05, 3, KOKSMA_VERDICT_FITTED},
                 {0.02, 0.0005, NONE, true, true, 0.0251, 0.05, 3, KOKSMA_VERDICT_UNEXPLAINED}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        one_row t;
        set_up(&t, cases[i].printed, cases[i].half_digit, cases[i].note);
        t.note.explained = cases[i].note >= IS_EXPLAINED;
        t.note.untested = cases[i].note == UNTESTED;
        t.table.fitted = cases[i].fitted;
        t.table.measure = cases[i].in_scene ? NULL : measure;
        t.table.scene = cases[i].in_scene ? scene : NULL;
        const koksma__cell cell = cell_of(cases[i].mean, cases[i].sd, cases[i].n);
        assert_int_equal(koksma__table_judge(&t.table, &t.row, 0, &cell).kind, cases[i].verdict);
    }
    for (int v = KOKSMA_VERDICT_NEW; v <= KOKSMA_VERDICT_UNTESTED; v++) {
        assert_non_null(koksma_study_verdict_name((koksma_study_verdict)v));
    }
    assert_null(koksma_study_verdict_name((koksma_study_verdict)(KOKSMA_VERDICT_UNTESTED + 1)));
}

/* Of a table over several n a note may be of one column. */
TEST_CASE(notes_are_of_columns)
{
    one_row t;
    set_up(&t, 0.282, 0.0005, 1);
    t.table.n.n = 3;
    t.note.n = 256;
    assert_int_equal(koksma__table_note(&t.table, "random", 16, 0), 0);
    assert_int_equal(koksma__table_note(&t.table, "random", 256, 0), 1);
    assert_int_equal(koksma__table_note(&t.table, "random", 256, 1), 0);
    assert_int_equal(koksma__table_note(&t.table, "jittered", 256, 0), 0);
}

/* Which cells a joint test takes does not depend on their z, only on notes and on whether there is chance in them. */
TEST_CASE(joint_tests_do_not_choose_by_z)
{
    one_row t;
    koksma__z_sums z = {0};
    set_up(&t, 0.282, 0.0005, 1);
    for (int i = 0; i < 3; i++) { /* z = 3.3, 0 and rounding alone */
        const koksma__cell cell = cell_of(i == 1 ? 0.282 : 0.26, i == 2 ? 0 : 0.05, 400);
        const koksma__verdict v = koksma__table_judge(&t.table, &t.row, 0, &cell);
        koksma__z_add(&z, &v, &cell);
    }
    assert_true(z.count == 2 && z.one_set == 1 && z.untested == 0 && z.squares > 9);
    t.note.untested = true;
    const koksma__cell cell = cell_of(0.282, 0.05, 400);
    const koksma__verdict v = koksma__table_judge(&t.table, &t.row, 0, &cell);
    koksma__z_add(&z, &v, &cell);
    assert_true(z.count == 2 && z.untested == 1);
}

/* By tables of the normal and chi-squared distributions: two-sided 5 % at 1.960, 5 %/12 at 2.865; chi-squared 95 % of 12
   at 21.03. */
TEST_CASE(joint_tests_have_their_limits)
{
    koksma__z_sums z = {.count = 4, .sum = 2 * 2.12, .squares = 9.4};
    assert_true(koksma__z_deviates(&z, 0.05) && !koksma__z_deviates(&z, 0.05 / 12) && !koksma__z_spreads(&z, 0.05));
    z.sum = 2 * 2.87;
    assert_true(koksma__z_deviates(&z, 0.05 / 12));
    z = (koksma__z_sums){.count = 12, .squares = 21.0};
    assert_false(koksma__z_spreads(&z, 0.05));
    z.squares = 21.1;
    assert_true(koksma__z_spreads(&z, 0.05) && !koksma__z_deviates(&z, 0.05));
    z.count = 1;
    assert_false(koksma__z_spreads(&z, 0.05));
}
