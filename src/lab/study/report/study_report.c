/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The report of a study: report.json, which holds every number (docs/report-format.md), and report.html, which is the
 * same text inside a page that shows it. The report depends only on the plan and the store, so that equal rows give
 * equal bytes, however often the run was interrupted; only the list of runs, which is one line of the text, may
 * differ. sections.def lists the sections, of which the three on the study's runs are here. Each file is replaced as a
 * whole, report.json first.
 */
#include <stdio.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "study/report/report.h"
#include "study/run/run.h"

static const struct {
    const char *name;
    const koksma__section *section;
} sections[] = {
#define SECTION(name) {#name, &koksma__section_##name},
#include "study/report/sections.def"
#undef SECTION
};

enum { N_SECTIONS = sizeof sections / sizeof *sections };

/* Appends the sections that every plan has (of_each_plan), or those that the whole study has once. */
static void add_sections(koksma__report *r, bool of_each_plan, koksma__document *d)
{
    for (size_t i = 0; !r->status && i < N_SECTIONS; i++) {
        const koksma__section *s = sections[i].section;
        koksma__document content = {0};
        if (s->of_each_plan != of_each_plan) {
            continue;
        }
        const koksma_run part = koksma__phase_run(&r->phases, r->all, r->share);
        r->run = &part;
        if (koksma__report_goes_on(r)) {
            s->write(r, &content);
            koksma__report_release(r);
        }
        r->run = NULL;
        if (!koksma__doc_is_empty(&content)) {
            koksma__doc_section(d, sections[i].name, "%s", s->heading);
            koksma__doc_append(d, &content);
            koksma__doc_end(d);
        }
    }
}

/* Appends the sections of one plan, under the plan's title and description if the study has several plans. */
static void add_plan(koksma__report *r, koksma__document *d)
{
    const koksma__plan_part *plan = &r->study->plan.parts[r->part];
    const bool alone = r->study->plan.n_parts == 1;
    if (!alone) {
        koksma__doc_section(d, NULL, "%s", plan->title);
    }
    if (!alone && plan->about) {
        koksma__doc_paragraph(d, "%s", plan->about);
    }
    add_sections(r, true, d);
    if (!alone) {
        koksma__doc_end(d);
    }
}

/* The rows are hashed, which takes one share of the progress; then each section takes one. */
static koksma_status build(koksma__report *r, koksma__document *d)
{
    const koksma__plan *plan = &r->study->plan;
    size_t shares = 1;
    for (size_t i = 0; i < N_SECTIONS; i++) {
        shares += sections[i].section->of_each_plan ? plan->n_parts : 1;
    }
    r->share = 1 / (double)shares;
    const koksma_run first = koksma__phase_run(&r->phases, r->all, r->share);
    if (koksma__report_keep(r, koksma__ask(&first))) {
        koksma__report_keep(r, koksma__rows_sha256(r->study->store, &first, r->rows));
    }
    koksma__doc_head(d, "koksma-report", plan->title, plan->n_parts == 1 && plan->about ? plan->about : "",
                     plan->name);
    koksma__json_write_flag(&d->json, "quick", r->study->quick);
    koksma__json_write_text(&d->json, "rows_sha256", r->rows);
    koksma__doc_content(d);
    for (; !r->status && r->part < plan->n_parts; r->part++) {
        add_plan(r, d);
    }
    add_sections(r, false, d);
    koksma__doc_close(d);
    koksma__json_end(&d->json);
    return r->status ? r->status : d->json.status;
}

static void join_all(char folder[KOKSMA__FOLDER], const koksma__texts *texts)
{
    for (size_t i = 0; i < texts->n; i++) {
        koksma__folder_join(folder, texts->at[i]);
    }
}

static void hide_folders(const koksma__plan *plan, koksma__document *d)
{
    char folder[KOKSMA__FOLDER] = "";
    for (size_t i = 0; i < plan->n_discrepancies; i++) {
        join_all(folder, &plan->discrepancies[i].patterns);
    }
    for (size_t i = 0; i < plan->n_images; i++) {
        join_all(folder, &plan->images[i].patterns);
        join_all(folder, &plan->images[i].scenes);
    }
    koksma__doc_hide_folder(d, folder);
}

koksma_status koksma_study_report(koksma_study *study, const koksma_run *run)
{
    KOKSMA__REQUIRE(study);
    KOKSMA__REQUIRE_RUN(run);
    koksma__document d = {0};
    koksma__report r = {.study = study, .all = run};
    KOKSMA__FAIL_IF(!study->store, KOKSMA_ARGUMENT, "a study without a folder has no report");
    koksma__study_forget_files(study);
    koksma_status status = build(&r, &d);
    koksma__mean_coherence_forget(&r);
    hide_folders(&study->plan, &d);
    status = status ? status : koksma__page_write(study->folder, d.json.text);
    koksma__json_writer_fini(&d.json);
    return status;
}

bool koksma_report_section_at(size_t i, koksma_entry *out)
{
    KOKSMA__REQUIRE_OR(false, out);
    const bool found = i < N_SECTIONS;
    *out = (koksma_entry){0};
    if (found) {
        *out = (koksma_entry){.name = sections[i].name, .title = sections[i].section->heading};
    }
    return found;
}

/* ---- Jobs without rows ------------------------------------------------------------------------------------- */

/* Tells how many jobs of the plan have no rows, so that nobody takes the tables of a part of a study for those of the
   whole. */
static void write_undone(koksma__report *r, koksma__document *d)
{
    size_t jobs = 0, undone = 0;
    if (koksma__report_keep(r, koksma__count_undone(r->study, &jobs, &undone)) && undone) {
        koksma__doc_warning(d,
                            "%zu of %zu jobs have no rows: a run ended before them, or made rows of files, scenes or "
                            "code that have changed since. `koksma study run` does them.",
                            undone, jobs);
    }
}

const koksma__section koksma__section_undone = {"Not done", false, write_undone};

/* Lists the sizes that blocks with `skip` leave out, and the jobs that failed when they ran. */
static void write_left_out(koksma__report *r, koksma__document *d)
{
    const char *line;
    if (koksma_study_left_out_at(r->study, 0)) {
        koksma__doc_paragraph(d,
                              "These combinations have no results; where trials are counted, only those have none:");
        koksma__doc_list(d, NULL, false);
    }
    for (size_t i = 0; koksma__report_goes_on(r) && (line = koksma_study_left_out_at(r->study, i)); i++) {
        koksma__doc_item(d, "%s", line);
    }
}

const koksma__section koksma__section_left_out = {"Left out", false, write_left_out};

/* ---- Origin ------------------------------------------------------------------------------------------------ */

static double percent(double part, double of)
{
    return of > 0 ? 100 * part / of : 0;
}

/* The program, the plan, and every run with its time and machine. The list of runs is one line of the report's text, so
   that reports of equal rows differ in that line only. */
static void write_origin(koksma__report *r, koksma__document *d)
{
    bool found = true;
    koksma__run_record run;
    koksma__doc_paragraph(
        d,
        "koksma %s, plan `%s`%s. The rows are in `results.sqlite` beside this file, and the numbers of this page in "
        "`report.json`. The key of a row is enough to make the row again. Results do not depend on the number of "
        "threads or on interruptions: `koksma study audit` makes rows again and compares them. The SHA-256 of all "
        "rows, as `koksma study export` writes them, is `%s`. The runs (one that was killed leaves its rows in the "
        "store, but no line here):",
        koksma_version(), r->study->plan.name, r->study->quick ? ", with the fewer trials of `--quick`" : "",
        r->rows);
    koksma__doc_list(d, "runs", false);
    for (long long i = 0; koksma__report_keep(r, koksma__store_run(r->study->store, i, &run, &found)) && found; i++) {
        koksma__doc_item(d,
                         "%s: %lld jobs in %.1f s with %lld workers on %s, koksma %s; idle %.1f %% of the time, in "
                         "the database %.1f %% of the processor time",
                         run.started, run.jobs, run.seconds, run.workers, run.machine, run.version,
                         percent(run.idle_seconds, (double)run.workers * run.seconds),
                         percent(run.store_seconds, run.processor_seconds));
    }
    koksma__doc_paragraph(d, "Intervals of means are " KOKSMA__MEAN_INTERVALS
                             ". Simulated 95 %% intervals of slopes and of relative changes hold in 94 to 98 %%, "
                             "those of numbers of samples in 92 to 96 %%.");
}

const koksma__section koksma__section_origin = {"How it was made", false, write_origin};
