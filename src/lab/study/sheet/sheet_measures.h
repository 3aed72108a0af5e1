/* SPDX-License-Identifier: Apache-2.0 */
/* Measures of samplers at several sizes over several trials. */
#ifndef KOKSMA_STUDY_SHEET_SHEET_MEASURES_H
#define KOKSMA_STUDY_SHEET_SHEET_MEASURES_H

#include "study/sheet/sheet.h"

/* Evaluates values->measures at all sizes and trials; leaves out measures without a value, with a note. */
koksma_status koksma__sheet_evaluate(koksma__sheet *sheet, koksma__sheet_values *values, const koksma_run *run);
void koksma__sheet_values_fini(koksma__sheet_values *values);
const koksma_tally *koksma__sheet_tally(const koksma__sheet_values *values, size_t s, size_t m, size_t i);

/* Writes a table of all values and the commands that compute them. */
void koksma__sheet_put_values(koksma__sheet *sheet, const koksma__sheet_values *values, const char *name,
                              koksma__document *d);

/* Whether samplers a and b have equal values of measure m at size number i that do not vary between sets. Means of values
   that vary are never called equal. */
bool koksma__sheet_equal(const koksma__sheet_values *values, size_t a, size_t b, size_t m, size_t i);

/* Compares samplers a and b by measure m at size number i. Returns 1 if a is better, -1 if b is better, and 0 if the
   test, whose level is 5 % divided by `tests`, does not decide. */
int koksma__sheet_compare(const koksma__sheet_values *values, size_t a, size_t b, size_t m, size_t i, size_t tests);

/* The first function evaluates the measures in the plane, the second writes their section. */
koksma_status koksma__sheet_measure_plane(koksma__sheet *sheet);
void koksma__sheet_put_measures(koksma__sheet *sheet, koksma__document *d);

#endif
