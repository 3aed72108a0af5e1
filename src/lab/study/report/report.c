/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The report of a study: report.json, which holds every number (docs/report-format.md), and report.html, which is the
 * same text inside a page that shows it. The report depends only on the plan and the store, so that equal rows give
 * equal bytes, however often the run was interrupted; only the list of runs, which is one line of the text, may
 * differ. sections.def lists the sections. Each file is replaced as a whole, report.json first.
 */
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "study/report/export.h"
#include "study/report/mean_coherence.h"
#include "study/report/page.h"
#include "study/report/report.h"

#define SECTION(name) extern const koksma__section koksma__section_##name;
#include "study/report/sections/sections.def"
#undef SECTION

static const struct {
    const char *name;
    const koksma__section *section;
} sections[] = {
#define SECTION(name) {#name, &koksma__section_##name},
#include "study/report/sections/sections.def"
#undef SECTION
};

/* The progress of a report: the rows are hashed once, then each section takes an equal share. */
typedef struct progress {
    koksma__phases phases;
    const koksma_run *run;
    double share;
} progress;

static void begin_progress(const koksma__plan *plan, const koksma_run *run, progress *p)
{
    size_t n = 1;
    for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) {
        n += sections[i].section->of_each_plan ? plan->n_parts : 1;
    }
    *p = (progress){.run = run, .share = 1 / (double)n};
}

/* Appends the sections that every plan has (of_each_plan), or those that the whole study has once. */
static koksma_status add_sections(koksma__report_scope *scope, progress *p, bool of_each_plan, koksma__document *d)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < sizeof sections / sizeof *sections; i++) {
        const koksma__section *s = sections[i].section;
        koksma__document content = {0};
        if (s->of_each_plan != of_each_plan) {
            continue;
        }
        const koksma_run part = koksma__phase_run(&p->phases, p->run, p->share);
        if (!koksma__keep_going(&part, 0)) {
            return koksma__fail_interrupted();
        }
        if (!s->is_shown(scope)) {
            continue;
        }
        scope->study->report = &part;
        status = s->write(scope, &content);
        scope->study->report = NULL;
        if (!koksma__doc_is_empty(&content)) {
            koksma__doc_section(d, sections[i].name, s->heading);
            koksma__doc_append(d, &content);
            koksma__doc_end(d);
        }
    }
    return status;
}

/* Appends the sections of one plan, under the plan's title and description if the study has several plans. */
static koksma_status add_plan(koksma__report_scope *scope, progress *p, koksma__document *d)
{
    const koksma__plan_part *plan = koksma__plan_of(scope);
    if (scope->study->plan.n_parts == 1) {
        return add_sections(scope, p, true, d);
    }
    koksma__doc_section(d, NULL, plan->title);
    if (plan->about) {
        koksma__doc_paragraph(d, "%s", plan->about);
    }
    const koksma_status status = add_sections(scope, p, true, d);
    koksma__doc_end(d);
    return status;
}

static koksma_status build(koksma_study *study, const koksma_run *run, koksma__document *d)
{
    const koksma__plan *plan = &study->plan;
    koksma__report_scope scope = {.study = study};
    progress p;
    begin_progress(plan, run, &p);
    const koksma_run first = koksma__phase_run(&p.phases, run, p.share);
    if (!koksma__keep_going(&first, 0)) {
        return koksma__fail_interrupted();
    }
    koksma_status status = koksma__rows_sha256(study->store, &first, scope.rows);
    d->json.in_html = true;
    koksma__json_begin_object(&d->json, NULL);
    koksma__json_write_text(&d->json, "format", "koksma-report");
    koksma__json_write_whole(&d->json, "version", 1);
    koksma__json_write_text(&d->json, "title", plan->title);
    koksma__json_write_text(&d->json, "about", plan->n_parts == 1 && plan->about ? plan->about : "");
    koksma__json_write_text(&d->json, "plan", plan->name);
    koksma__json_write_text(&d->json, "koksma", koksma_version());
    koksma__json_write_text(&d->json, "rows_sha256", scope.rows);
    koksma__json_begin_array(&d->json, "content");
    for (; !status && scope.plan < plan->n_parts; scope.plan++) {
        status = add_plan(&scope, &p, d);
    }
    status = status ? status : add_sections(&scope, &p, false, d);
    koksma__json_end(&d->json);
    koksma__json_end(&d->json);
    return status ? status : d->json.status;
}

koksma_status koksma_study_report(koksma_study *study, const koksma_run *run)
{
    KOKSMA__REQUIRE(study);
    KOKSMA__REQUIRE_RUN(run);
    koksma__document d = {0};
    KOKSMA__FAIL_IF(!study->store, KOKSMA_ARGUMENT, "a study without a folder has no report");
    koksma__study_forget_files(study);
    koksma_status status = build(study, run, &d);
    koksma__mean_coherence_forget(study);
    status = status ? status : koksma__page_write(study->folder, KOKSMA__PAGE_STUDY, d.json.text);
    koksma__json_writer_fini(&d.json);
    return status;
}

bool koksma_report_section_at(size_t i, koksma_entry *out)
{
    KOKSMA__REQUIRE_OR(false, out);
    const bool found = i < sizeof sections / sizeof *sections;
    *out = (koksma_entry){0};
    if (found) {
        *out = (koksma_entry){.name = sections[i].name, .title = sections[i].section->heading};
    }
    return found;
}
