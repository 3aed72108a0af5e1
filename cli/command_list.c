/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma list`: the members of the library's tables, one function a table. */
#include <stdio.h>
#include <string.h>

#include <koksma/adaptive.h>
#include <koksma/optimise.h>
#include <koksma/study.h>
#include <koksma/verify.h>
#include <koksma/warp.h>

#include "curves.h"
#include "texts.h"

static const struct {
    unsigned claim;
    const char *name, *meaning;
} claim_lines[] = {
#define KOKSMA_CLAIM(id, bit, name, meaning) {KOKSMA_CLAIM_##id, name, meaning},
#include <koksma/claims.def>
#undef KOKSMA_CLAIM
};

/* The last columns of a row. cite: NULL: no source */
static void end_row(cli_rows *rows, const char *cite, const char *title)
{
    if (cite) {
        cli_row_text(rows, "source", cite);
    }
    cli_row_text(rows, "what", title);
    cli_row_end(rows);
}

static void put_dims(cli_rows *rows, int min_dim, int max_dim)
{
    char text[32];
    snprintf(text, sizeof text, min_dim == max_dim ? "%d" : "%d-%d", min_dim, max_dim);
    cli_row_text(rows, "dim", text);
}

static void put_params(cli_rows *rows, const koksma_param *params)
{
    char text[512] = "";
    for (; params && params->name; params++) {
        const size_t used = strlen(text);
        const char *separator = used ? "," : "";
        if (params->choices) {
            snprintf(text + used, sizeof text - used, "%s%s=%s", separator, params->name,
                     params->choices[(int)params->fallback]);
        } else {
            snprintf(text + used, sizeof text - used, "%s%s=%g", separator, params->name, params->fallback);
        }
    }
    cli_row_text(rows, "parameters", *text ? text : "-");
}

static void list_patterns(cli_rows *rows)
{
    const koksma_pattern *p;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        char claims[256] = "";
        for (size_t c = 0; c < sizeof claim_lines / sizeof *claim_lines; c++) {
            if (p->claims & claim_lines[c].claim) {
                const size_t used = strlen(claims);
                snprintf(claims + used, sizeof claims - used, "%s%s", used ? "," : "", claim_lines[c].name);
            }
        }
        cli_row_text(rows, "pattern", p->name);
        put_dims(rows, p->min_dim, p->max_dim);
        put_params(rows, p->params);
        cli_row_text(rows, "claims", *claims ? claims : "-");
        end_row(rows, p->cite, p->title);
    }
}

static void list_measures(cli_rows *rows)
{
    const koksma_measure *m;
    for (size_t i = 0; (m = koksma_measure_at(i)); i++) {
        cli_row_text(rows, "measure", m->name);
        put_dims(rows, m->min_dim, m->max_dim);
        put_params(rows, m->params);
        cli_row_text(rows, "cost", m->cost);
        end_row(rows, m->cite, m->title);
    }
}

static void list_scenes(cli_rows *rows)
{
    for (size_t i = 0; koksma_scene_name_at(i); i++) {
        koksma_scene *scene;
        cli_row_text(rows, "scene", koksma_scene_name_at(i));
        /* an error: files of a package that is not installed */
        const bool opened = !koksma_scene_open(koksma_scene_name_at(i), &scene);
        end_row(rows, NULL, opened ? koksma_scene_title(scene) : koksma_error_text());
        koksma_scene_close(opened ? scene : NULL);
    }
}

static void list_integrators(cli_rows *rows)
{
    const koksma_integrator *in;
    for (size_t i = 0; (in = koksma_integrator_at(i)); i++) {
        cli_row_text(rows, "integrator", in->name);
        cli_row_whole(rows, "depth", (uint64_t)in->depth);
        end_row(rows, in->cite, in->title);
    }
}

static void list_filters(cli_rows *rows)
{
    const koksma_filter *f;
    for (size_t i = 0; (f = koksma_filter_at(i)); i++) {
        cli_row_text(rows, "filter", f->name);
        cli_row_number(rows, "radius", f->radius);
        end_row(rows, f->cite, f->title);
    }
}

static void list_adaptive(cli_rows *rows)
{
    const koksma_adaptive *a;
    for (size_t i = 0; (a = koksma_adaptive_at(i)); i++) {
        cli_row_text(rows, "method", a->name);
        put_params(rows, a->params);
        cli_row_text(rows, "samples", a->own_samples ? "own strata" : "sets of the pattern");
        end_row(rows, a->cite, a->title);
    }
}

static void list_warps(cli_rows *rows)
{
    static const char *const domains[] = {[KOKSMA_DOMAIN_DISK] = "disk",
                                          [KOKSMA_DOMAIN_TRIANGLE] = "triangle",
                                          [KOKSMA_DOMAIN_HEMISPHERE] = "hemisphere",
                                          [KOKSMA_DOMAIN_HEMISPHERE_COSINE] = "hemisphere, density z/pi"};
    const koksma_warp *w;
    for (size_t i = 0; (w = koksma_warp_at(i)); i++) {
        cli_row_text(rows, "warp", w->name);
        cli_row_text(rows, "domain", domains[w->domain]);
        end_row(rows, w->cite, w->title);
    }
}

static void list_methods(cli_rows *rows)
{
    const koksma_method *m;
    for (size_t i = 0; (m = koksma_method_at(i)); i++) {
        cli_row_text(rows, "method", m->name);
        cli_row_text(rows, "source", m->cite);
        cli_row_text(rows, "what", m->title);
        cli_row_end(rows);
    }
}

static void put_range(cli_rows *rows, const koksma_param *p)
{
    char text[256] = "";
    if (p->choices) {
        for (size_t i = 0; p->choices[i]; i++) {
            const size_t used = strlen(text);
            snprintf(text + used, sizeof text - used, "%s%s", used ? " " : "", p->choices[i]);
        }
    } else {
        snprintf(text, sizeof text, "%g to %g", p->min, p->max);
    }
    cli_row_text(rows, "range", text);
}

static void list_parameters_of(cli_rows *rows, const char *member, const koksma_param *params)
{
    for (const koksma_param *p = params; p && p->name; p++) {
        cli_row_text(rows, "of", member);
        cli_row_text(rows, "parameter", p->name);
        if (p->choices) {
            cli_row_text(rows, "default", p->choices[(int)p->fallback]);
        } else {
            cli_row_number(rows, "default", p->fallback);
        }
        put_range(rows, p);
        end_row(rows, NULL, p->help);
    }
}

static void list_parameters(cli_rows *rows)
{
    const koksma_pattern *p;
    const koksma_measure *m;
    const koksma_adaptive *a;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        list_parameters_of(rows, p->name, p->params);
    }
    for (size_t i = 0; (m = koksma_measure_at(i)); i++) {
        list_parameters_of(rows, m->name, m->params);
    }
    for (size_t i = 0; (a = koksma_adaptive_at(i)); i++) {
        list_parameters_of(rows, a->name, a->params);
    }
}

static void list_uses(cli_rows *rows)
{
    const koksma_use *u;
    for (size_t i = 0; (u = koksma_use_at(i)); i++) {
        cli_row_text(rows, "use", u->name);
        cli_row_whole(rows, "dim", (uint64_t)u->dim);
        end_row(rows, NULL, u->help);
    }
}

static void list_formats(cli_rows *rows)
{
    const char *name, *left_out;
    for (size_t i = 0; (name = koksma_image_format(i, &left_out)); i++) {
        char path[32];
        snprintf(path, sizeof path, "x.%s", name);
        cli_row_text(rows, "format", name);
        cli_row_text(rows, "layers", koksma_image_has_layers(path) ? "all" : "the image");
        cli_row_text(rows, "lacks", left_out ? left_out : "-");
        cli_row_end(rows);
    }
}

static void list_curves(cli_rows *rows)
{
    const cli_curve *c;
    for (size_t i = 0; (c = cli_curve_at(i)); i++) {
        cli_row_text(rows, "curve", c->name);
        cli_row_text(rows, "by",
                     c->print.options && c->plot.options ? "curve,plot"
                     : c->plot.options                   ? "plot"
                                                         : "curve");
        end_row(rows, c->cite, c->meaning);
    }
}

static void list_claims(cli_rows *rows)
{
    for (size_t i = 0; i < sizeof claim_lines / sizeof *claim_lines; i++) {
        cli_row_text(rows, "claim", claim_lines[i].name);
        end_row(rows, NULL, claim_lines[i].meaning);
    }
}

static void list_properties(cli_rows *rows)
{
    const koksma_property *p;
    for (size_t i = 0; (p = koksma_property_at(i)); i++) {
        cli_row_text(rows, "property", p->name);
        end_row(rows, NULL, p->meaning);
    }
}

static void list_plans(cli_rows *rows)
{
    for (size_t i = 0; koksma_plan_name_at(i); i++) {
        cli_row_text(rows, "plan", koksma_plan_name_at(i));
        cli_row_end(rows);
    }
}

static void put_entry(cli_rows *rows, const char *noun, const koksma_entry *entry)
{
    cli_row_text(rows, noun, entry->name);
    if (*entry->fields) {
        cli_row_text(rows, "fields", entry->fields);
    }
    end_row(rows, entry->cite, entry->title);
}

#define LIST(table, noun, at)                                                                                        \
    static void list_##table(cli_rows *rows)                                                                         \
    {                                                                                                                \
        koksma_entry entry;                                                                                          \
        for (size_t i = 0; at; i++) {                                                                                \
            put_entry(rows, noun, &entry);                                                                           \
        }                                                                                                            \
    }
LIST(materials, "material", koksma_scene_kind_at("materials", i, &entry))
LIST(lights, "light", koksma_scene_kind_at("lights", i, &entry))
LIST(shapes, "shape", koksma_scene_kind_at("shapes", i, &entry))
LIST(pipelines, "pipeline", koksma_pipeline_at(i, &entry))
LIST(questions, "question", koksma_question_at(i, &entry))
LIST(sections, "section", koksma_report_section_at(i, &entry))

static const struct {
    const char *name;
    void (*list)(cli_rows *rows);
} lists[] = {
    {"patterns", list_patterns},     {"measures", list_measures},   {"claims", list_claims},
    {"properties", list_properties}, {"warps", list_warps},         {"curves", list_curves},
    {"scenes", list_scenes},         {"materials", list_materials}, {"lights", list_lights},
    {"shapes", list_shapes},         {"formats", list_formats},     {"integrators", list_integrators},
    {"pipelines", list_pipelines},   {"filters", list_filters},     {"uses", list_uses},
    {"adaptive", list_adaptive},     {"methods", list_methods},     {"plans", list_plans},
    {"questions", list_questions},   {"sections", list_sections},   {"parameters", list_parameters},
};

const char *cli_list_names(const char *comma, char *text, size_t size)
{
    size_t used = 0;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        used += (size_t)snprintf(text + used, size - used, "%s%s", i ? comma : "", lists[i].name);
    }
    return text;
}

static int run(const cli_arguments *arguments)
{
    char names[512];
    const char *which = arguments->n_operands ? arguments->operands[0] : NULL;
    bool found = !which;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        found = found || !strcmp(which, lists[i].name);
    }
    if (!found || arguments->n_operands > 1) {
        return cli_usage_error(arguments, "it takes one of %s", cli_list_names(", ", names, sizeof names));
    }
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        if (!which || !strcmp(which, lists[i].name)) {
            lists[i].list(rows);
        }
    }
    return cli_rows_close(rows);
}

static const cli_option options[] = {CLI_ROW_OPTIONS, {0}};

const cli_command cli_command_list = {
    .name = "list",
    .summary = "list the members of a table",
    .synopsis = "[{lists}] [--json]",
    .details =
        "uses are what a sample is spent on, with their dimensions: 'koksma render -p USE=PATTERN' samples one by a\n"
        "pattern of its own, '-p USE+USE=PATTERN' several by one pattern of their dimensions together.",
    .examples = "koksma list patterns\n"
                "koksma list scenes --json\n",
    .options = options,
    .run = run,
};
