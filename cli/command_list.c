/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma list`: the members of the library's tables, one function a table. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <koksma/adaptive.h>
#include <koksma/optimise.h>
#include <koksma/warp.h>

#include "texts.h"

static const struct {
    unsigned claim;
    const char *name;
} claim_names[] = {
#define KOKSMA_CLAIM(id, bit, name, meaning) {KOKSMA_CLAIM_##id, name},
#include <koksma/claims.def>
#undef KOKSMA_CLAIM
};

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
        for (size_t c = 0; c < sizeof claim_names / sizeof *claim_names; c++) {
            if (p->claims & claim_names[c].claim) {
                const size_t used = strlen(claims);
                snprintf(claims + used, sizeof claims - used, "%s%s", used ? "," : "", claim_names[c].name);
            }
        }
        cli_row_text(rows, "pattern", p->name);
        put_dims(rows, p->min_dim, p->max_dim);
        put_params(rows, p->params);
        cli_row_text(rows, "claims", *claims ? claims : "-");
        cli_row_text(rows, "source", p->cite);
        cli_row_text(rows, "what", p->title);
        cli_row_end(rows);
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
        cli_row_text(rows, "source", m->cite);
        cli_row_text(rows, "what", m->title);
        cli_row_end(rows);
    }
}

static void list_scenes(cli_rows *rows)
{
    for (size_t i = 0; koksma_scene_name_at(i); i++) {
        koksma_scene *scene;
        cli_row_text(rows, "scene", koksma_scene_name_at(i));
        if (koksma_scene_open(koksma_scene_name_at(i), &scene)) {
            cli_row_text(rows, "what", koksma_error_text()); /* files of a package that is not installed */
        } else {
            cli_row_text(rows, "what", koksma_scene_title(scene));
            koksma_scene_close(scene);
        }
        cli_row_end(rows);
    }
}

static void list_integrators(cli_rows *rows)
{
    const koksma_integrator *in;
    for (size_t i = 0; (in = koksma_integrator_at(i)); i++) {
        cli_row_text(rows, "integrator", in->name);
        cli_row_whole(rows, "depth", (uint64_t)in->depth);
        cli_row_text(rows, "source", in->cite);
        cli_row_text(rows, "what", in->title);
        cli_row_end(rows);
    }
}

static void list_filters(cli_rows *rows)
{
    const koksma_filter *f;
    for (size_t i = 0; (f = koksma_filter_at(i)); i++) {
        cli_row_text(rows, "filter", f->name);
        cli_row_number(rows, "radius", f->radius);
        cli_row_text(rows, "source", f->cite);
        cli_row_text(rows, "what", f->title);
        cli_row_end(rows);
    }
}

static void list_adaptive(cli_rows *rows)
{
    const koksma_adaptive *a;
    for (size_t i = 0; (a = koksma_adaptive_at(i)); i++) {
        cli_row_text(rows, "method", a->name);
        put_params(rows, a->params);
        cli_row_text(rows, "samples", a->own_samples ? "own strata" : "sets of the pattern");
        cli_row_text(rows, "source", a->cite);
        cli_row_text(rows, "what", a->title);
        cli_row_end(rows);
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
        cli_row_text(rows, "source", w->cite);
        cli_row_text(rows, "what", w->title);
        cli_row_end(rows);
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

static void list_records(cli_rows *rows)
{
    const koksma_record *r;
    for (size_t i = 0; (r = koksma_record_at(i)); i++) {
        cli_row_text(rows, "measure", r->measure);
        cli_row_whole(rows, "dim", (uint64_t)r->dim);
        cli_row_whole(rows, "n", r->n);
        cli_row_number(rows, "value", r->value);
        cli_row_number(rows, "published", r->published > 0 ? r->published : (double)NAN);
        cli_row_text(rows, "source", r->source);
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
        cli_row_text(rows, "what", p->help);
        cli_row_end(rows);
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
        cli_row_text(rows, "what", u->help);
        cli_row_end(rows);
    }
}

static const struct {
    const char *name;
    void (*list)(cli_rows *rows);
} lists[] = {
    {"patterns", list_patterns},       {"measures", list_measures},     {"scenes", list_scenes},
    {"integrators", list_integrators}, {"filters", list_filters},       {"uses", list_uses},
    {"adaptive", list_adaptive},       {"warps", list_warps},           {"methods", list_methods},
    {"records", list_records},         {"parameters", list_parameters},
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
    char names[256];
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
    .options = options,
    .run = run,
};
