#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""misuse.py CLANG INCLUDE OUT: writes a C file that calls every public function with every argument wrong in turn.

The functions, their parameters and the members of the structs come from the headers, as clang parses them: a new function is
under test at once, and this script stops if it has no valid arguments for it. A case takes valid arguments (VALID below),
puts one wrong value at one place, an argument or a member of the struct that it points to, and calls. test_misuse.c
runs the cases and has the rules for what must come of them. Inline functions take any pointer on trust; for other arguments
each ends in its KOKSMA_ASSERT, or comes back.
"""
import json
import os
import re
import subprocess
import sys

clang, include, out = sys.argv[1:4]

# Valid arguments: by FUNCTION.PARAMETER, by PARAMETER:TYPE, or by TYPE. Functions called here are in test_misuse.c. A list
# has several, each of which is made wrong in turn.
VALID = {
    "size_t": "0", "uint64_t": "7", "_Bool": "0", "double": "0.25", "i:size_t": "0",
    "const char *": "\"jittered\"", "char *": "a_buffer(KOKSMA_MAX_PATTERNS_TEXT)",
    "path:const char *": "work_path(\"out.npy\")", "comment:const char *": "\"a comment\"", "metadata:const char *": "NULL",
    "koksma_run *": ["NULL", "a_run()"], "koksma_points *": "points_of(16)", "koksma_value *": "a_buffer(sizeof(koksma_value) * 2)",
    "koksma_spec *": ["a_pattern(\"gaussian-jittered:sigma=0.2\")", "a_pattern(work_path(\"file:in.npy\"))"],
    "measure:koksma_spec *": "a_measure(\"l2-disk\")", "koksma_line *": "a_buffer(sizeof(koksma_line))",
    "koksma_pattern *": "koksma_pattern_find(\"jittered\")", "koksma_measure *": "koksma_measure_find(\"star\")",
    "koksma_warp *": "koksma_warp_find(\"concentric-disk\")", "koksma_filter *": "koksma_filter_find(\"tent\")",
    "koksma_tally *": "a_tally()", "koksma_spectrum *": "a_spectrum()", "koksma_ring *": "a_buffer(4 * sizeof(koksma_ring))",
    "koksma_spectrum_method": "KOKSMA_SPECTRUM_FAST", "koksma_spectrum_quality_values *": "a_buffer(sizeof(koksma_spectrum_quality_values))",
    "koksma_status": "KOKSMA_N", "koksma_pairing": "KOKSMA_PAIRING_NATIVE", "koksma_scope": "KOKSMA_SCOPE_IMAGE",
    "koksma_light_selection": "KOKSMA_LIGHTS_ONE", "koksma_study_verdict": "KOKSMA_VERDICT_AGREES",
    "koksma_plot_format": "KOKSMA_PLOT_SVG", "koksma_plot_format *": "a_buffer(sizeof(koksma_plot_format))",
    "koksma_scatter_options *": ["scatter_options(false)", "scatter_options(true)"], "koksma_panel *": "two_panels()", "koksma_chart *": "a_chart()", "koksma_figure *": "a_figure()",
    "specs:const char * *": "two_specs()", "numbers:size_t *": "a_buffer(2 * sizeof(size_t))", "koksma_plot_colours.n": "2",
    "koksma_strata_panel *": "a_strata_panel()", "unsigned char **": "a_buffer(sizeof(char *))", "const unsigned char *": "a_buffer(16)",
    "size_t *": "a_buffer(sizeof(size_t))", "const char **": "a_buffer(sizeof(char *))",
    "double *": "a_buffer(16 * sizeof(double))", "const double *": "three_numbers()", "uint32_t *": "a_buffer(16 * sizeof(uint32_t))",
    "koksma_image *": "an_image()", "koksma_layer *": "two_layers()", "koksma_image_error *": "a_buffer(sizeof(koksma_image_error))",
    "koksma_metric_spec *": "a_metric()", "koksma_metric_value *": "a_buffer(sizeof(koksma_metric_value))", "koksma_metric_find.name": "\"rmse\"",
    "koksma_metric_parse.text": "\"hdr-flip:ppd=40\"", "koksma_metric_parse.spec": "a_buffer(sizeof(koksma_metric_spec))",
    "koksma_scene_part *": "a_buffer(sizeof(koksma_scene_part))", "koksma_coherence *": "a_coherence()", "koksma_coherence_values *": "a_buffer(sizeof(koksma_coherence_values))",
    "koksma_scene_set_sky.image": "NULL", "koksma_scene *": "a_scene()", "koksma_scene **": "a_buffer(sizeof(void *))",
    "koksma_render_options *": ["render_options(\"gaussian-jittered\")", "render_options(\"random;pixel=gaussian-jittered;lens+time=random\")"],
    "koksma_use_group *": "a_group()", "koksma_layers *": "a_buffer(sizeof(koksma_layers))",
    "koksma_strata *": "a_buffer(sizeof(koksma_strata))", "koksma_adaptive_options *": "adaptive_options()",
    "koksma_adaptive_report *": "a_buffer(sizeof(koksma_adaptive_report))",
    "koksma_study_options *": "study_options()", "koksma_study *": "a_study()", "koksma_study **": "a_buffer(sizeof(void *))",
    "koksma_study_summary *": "a_buffer(sizeof(koksma_study_summary))", "koksma_study_cost *": "a_buffer(sizeof(koksma_study_cost))",
    "koksma_export_format": "KOKSMA_EXPORT_CSV", "koksma_study_row *": "a_buffer(sizeof(koksma_study_row))", "_Bool *": "a_buffer(sizeof(bool))",
    "koksma_images_row **": "a_buffer(sizeof(void *))", "koksma_rank_options *": "rank_options()",
    "koksma_rank_row *": "a_buffer(2 * sizeof(koksma_rank_row))", "koksma_ranking *": "a_buffer(sizeof(koksma_ranking))",
    "koksma_replicates *": "a_buffer(sizeof(koksma_replicates))", "koksma_replicates_fini.replicates": "a_zero(sizeof(koksma_replicates))",
    "koksma_render_replicates.replicates": "4", "koksma_render_replicates.options": ["render_options(\"gaussian-jittered:shift=1\")", "render_options(\"random;pixel=gaussian-jittered:shift=1;lens+time=random\")"], "koksma_target_row *": "a_buffer(2 * sizeof(koksma_target_row))", "koksma_target_ranking *": "a_buffer(sizeof(koksma_target_ranking))",
    "koksma_verify_sets.sets": "many_sets()", "koksma_verify_sets.n_sets": "KOKSMA_VERIFY_SETS",
    "koksma_findings *": "a_buffer(sizeof(koksma_findings))", "koksma_identities *": "a_buffer(sizeof(koksma_identities))",
    "koksma_identity *": "a_zero(sizeof(koksma_identity))",
    "koksma_points_init.n": "4", "koksma_points_init.dim": "2", "koksma_points_init.points": "a_buffer(sizeof(koksma_points))",
    "koksma_points_fini.points": "a_zero(sizeof(koksma_points))", "koksma_points_read.path": "work_path(\"in.npy\")",
    "koksma_points_read.points": "a_buffer(sizeof(koksma_points))", "koksma_generate_whole.out": "a_buffer(sizeof(koksma_points))",
    "koksma_generate_range.spec": "a_pattern(\"sobol\")", "koksma_generate_sets.sets": "4", "koksma_evaluate_sets.sets": "2",
    "koksma_evaluate_sets.spec": "a_measure(\"l2-disk\")", "koksma_generate_write.spec": "a_pattern(\"sobol\")",
    "koksma_points_read_mapped.path": "work_path(\"in.npy\")", "koksma_points_read_mapped.points": "a_buffer(sizeof(koksma_points))",
    "koksma_generate_write.n": "7", "koksma_generate_write.dim": "2", "koksma_has_ranges.spec": "a_pattern(\"sobol\")",
    "koksma_generate_whole.dim": "2", "koksma_generate_whole.spec": "a_pattern(work_path(\"file:in.npy\"))",
    "koksma_pattern_spec.spec": "a_buffer(sizeof(koksma_spec))", "koksma_measure_spec.spec": "a_buffer(sizeof(koksma_spec))",
    "koksma_measure_spec.text": "\"star\"", "koksma_measure_find.name": "\"star\"",
    "koksma_local_discrepancy_grid.side": "4", "koksma_evaluate.spec": "a_measure(\"l2-disk\")",
    "koksma_student_975.degrees": "3", "koksma_log_line.n": "3", "koksma_evaluate_prefixes.n_sizes": "2",
    "koksma_evaluate_prefixes.sizes": "two_sizes()", "koksma_rate.dim": "2", "koksma_best_rate.dim": "2",
    "koksma_spectrum_init.half": "4", "koksma_spectrum_init.spectrum": "a_buffer(sizeof(koksma_spectrum))",
    "koksma_spectrum_fini.spectrum": "a_zero(sizeof(koksma_spectrum))",
    "koksma_spectrum_power.kx": "1", "koksma_spectrum_power.ky": "1", "koksma_pair_correlation.bins": "16",
    "koksma_generate_density.spec": "a_pattern(\"sample-elimination\")", "koksma_generate_on.spec": "a_pattern(\"sample-elimination\")",
    "koksma_generate_rectangle.spec": "a_pattern(\"sample-elimination\")", "koksma_generate_rectangle.width": "4",
    "koksma_generate_rectangle.height": "1",
    "koksma_generate_on.path": "work_path(\"in.off\")", "koksma_generate_on.out": "points_in_space()",
    "koksma_warp_find.name": "\"triangle\"", "koksma_warp_points.out": "a_buffer(sizeof(koksma_points))", "koksma_warp_evaluate.measure": "a_measure(\"edge\")",
    "koksma_plot_format_of.path": "\"a.svg\"", "koksma_plot_panels.n": "2", "koksma_plot_panels.size": "64", "koksma_plot_strata.n": "1",
    "koksma_plot_strata.size": "64", "koksma_plot_write.size": "16",
    "koksma_image_init.image": "a_buffer(sizeof(koksma_image))", "koksma_image_init.width": "4", "koksma_image_init.height": "4",
    "koksma_image_init.channels": "3", "koksma_image_fini.image": "a_zero(sizeof(koksma_image))",
    "koksma_image_read.path": "work_path(\"in.pfm\")", "koksma_image_read.out": "a_buffer(sizeof(koksma_image))",
    "koksma_image_check_path.path": "\"a.png\"", "koksma_image_has_layers.path": "\"a.exr\"",
    "koksma_image_write.path": "work_path(\"out.pfm\")", "koksma_image_write_layers.path": "work_path(\"out.exr\")",
    "koksma_image_write_layers.n": "2", "koksma_image_check_finite.name": "\"image\"",
    "koksma_image_difference.out": "a_buffer(sizeof(koksma_image))", "koksma_image_blur.out": "a_buffer(sizeof(koksma_image))",
    "koksma_rank_process_by_command.out": "a_buffer(sizeof(koksma_image))", "koksma_coherence_init.coherence": "a_buffer(sizeof(koksma_coherence))",
    "koksma_coherence_init.width": "4", "koksma_coherence_init.height": "4", "koksma_coherence_fini.coherence": "a_zero(sizeof(koksma_coherence))",
    "koksma_scene_open.name_or_path": "\"ball\"", "koksma_scene_warning.size": "256", "koksma_scene_unknown.size": "256", "koksma_integrator_find.name": "\"whitted\"",
    "koksma_filter_find.name": "\"tent\"", "koksma_render_warning.size": "256", "koksma_layers_fini.layers": "a_zero(sizeof(koksma_layers))",
    "koksma_aovs *": "a_zero(sizeof(koksma_aovs))", "koksma_aovs_parse.text": "\"direct,half\"",
    "koksma_scene_close.scene": "open_scene()", "koksma_render.out": "a_buffer(sizeof(koksma_image))",
    "koksma_render_patterns.text": "\"random;pixel+time=scan-time\"",
    "koksma_adaptive_find.name": "\"contrast\"", "koksma_strata_fini.strata": "a_zero(sizeof(koksma_strata))",
    "koksma_adaptive_parse.text": "\"contrast\"", "koksma_adaptive_parse.out": "a_buffer(sizeof(koksma_adaptive_options))",
    "koksma_mask_void_and_cluster.size": "4", "koksma_mask_void_and_cluster_3d.size": "4", "koksma_mask_void_and_cluster_3d.frames": "4",
    "koksma_mask_space_find.name": "\"scalar\"", "koksma_mask_space *": "(void *)(uintptr_t)koksma_mask_space_at(0)", "koksma_mask_options *": "mask_options()",
    "koksma_mask_result *": "a_buffer(sizeof(koksma_mask_result))", "koksma_mask_quality *": "a_buffer(sizeof(koksma_mask_quality))",
    "koksma_mask_filter *": "a_mask_filter()", "koksma_mask_filter_parse.out": "a_buffer(sizeof(koksma_mask_filter))", "koksma_mask_filter_parse.text": "\"box:size=3\"",
    "koksma_mask_optimise.values": "a_buffer(64 * sizeof(float))", "koksma_mask_measure.values": "a_zero(64 * sizeof(float))", "koksma_mask_measure.width": "8",
    "koksma_mask_measure.height": "8", "koksma_mask_measure.tests": "4", "koksma_mask *": "a_mask()", "koksma_mask_fini.mask": "a_zero(sizeof(koksma_mask))",
    "koksma_mask_read.path": "mask_file()", "koksma_mask_read.out": "a_buffer(sizeof(koksma_mask))", "koksma_mask_check_path.path": "\"a.png\"",
    "koksma_mask_check_path.bits": "8", "koksma_mask_write.path": "work_path(\"mask.raw\")", "koksma_mask_write.bits": "8",
    "koksma_mask_write_recipe.path": "work_path(\"mask.json\")", "koksma_mask_write_recipe.filter": "\"box:size=3\"", "koksma_mask_write_recipe.from": "\"a.png\"",
    "koksma_mask_write_recipe.result": "a_zero(sizeof(koksma_mask_result))", "koksma_mask_read_recipe.path": "mask_recipe()",
    "koksma_mask_read_recipe.out": "a_buffer(sizeof(koksma_mask_options))", "koksma_mask_rings.rings": "4", "koksma_mask_histogram.bins": "4", "koksma_mask_datasheet.masks": "a_circle_mask()", "koksma_mask_datasheet.n": "1", "koksma_mask_datasheet.n_filters": "1", "koksma_mask_datasheet.names": "a_text_list(\"box:size=3\")", "koksma_mask_datasheet.filters": "a_text_list(\"box:size=3\")", "koksma_mask_power.power": "a_buffer(64 * sizeof(double))",
    "koksma_mask_correlation.out": "a_buffer(64 * sizeof(double))", "koksma_mask_histogram.counts": "a_buffer(4 * sizeof(size_t))",
    "koksma_mask_vectors.size": "4", "koksma_mask_vectors.dim": "1",
    "koksma_mask_void_and_cluster_3d.ranks": "a_buffer(64 * sizeof(uint32_t))", "koksma_render_options_init.options": "a_buffer(sizeof(koksma_render_options))",
    "koksma_render_patterns.options": "render_options(\"jittered\")", "koksma_plan_try.pattern": "\"jittered\"", "koksma_plan_try.n": "4", "koksma_plan_try.dim": "2", "koksma_plan_try_measure.measure": "\"star\"", "koksma_plan_try_measure.n": "4", "koksma_plan_try_measure.dim": "2", "koksma_plan_write.folder": "study_folder()", "koksma_plan_write.text": "a_plan()", "koksma_study_export.folder": "work_path(\"done\")", "koksma_study_left_out.folder": "work_path(\"done\")", "koksma_study_table_row.id": "\"5.1\"",
    "koksma_study_images.places": "work_path(\"in_{trial}.pfm\")", "koksma_study_images.reference": "work_path(\"in.pfm\")", "koksma_study_images.folder": "work_path(\"images\")",
    "koksma_name_at *": "a_name", "koksma_closest_name.table": "NULL", "koksma_closest_name.word": "\"jitered\"", "koksma_text_escape.text": "a_copy(\"jittered\", 9)",
    "koksma_text_escape.size": "9", "koksma_entry *": "a_buffer(sizeof(koksma_entry))", "koksma_scene_kind_at.member": "\"lights\"",
    "koksma_method_find.name": "\"descent\"", "koksma_optimise_options *": "optimise_options()", "koksma_optimise.measure": "a_measure(\"l2-disk\")",
    "koksma_processes *": "a_buffer(sizeof(koksma_processes))", "koksma_net_write.path": "work_path(\"net.txt\")",
    "koksma_net_write.points": "digital_points()", "koksma_radial_power.text": "\"step\"", "koksma_radial_power.rings": "4",
    "koksma_radial_power.n": "16",
    "koksma_optimum *": "a_buffer(sizeof(koksma_optimum))", "koksma_optimum_fini.best": "a_zero(sizeof(koksma_optimum))",
    "koksma_datasheet_options *": "datasheet_options()", "char **": "a_buffer(sizeof(char *))",
    "koksma_datasheet_page.json": "\"{\\\"format\\\":\\\"koksma-datasheet\\\"}\"",
    "koksma_joint *": "a_zero(sizeof(koksma_joint))", "koksma_joint_line.n": "3", "koksma_joint_add.n": "3",
    "koksma_integral *": "open_integral()", "koksma_integral **": "a_buffer(sizeof(void *))",
    "koksma_integral_facts *": "a_buffer(sizeof(koksma_integral_facts))", "koksma_function *": "a_function()",
    "koksma_integration_options *": "integration_options()", "koksma_integration *": "a_buffer(sizeof(koksma_integration))",
    "koksma_sensitivity *": "a_buffer(sizeof(koksma_sensitivity))", "const int *": "two_axes()",
    "koksma_integrand_find.name": "\"disk\"", "koksma_integral_open.text": "\"disk\"", "koksma_integral_open.dim": "2",
    "koksma_integral_of_function.dim": "2", "koksma_integral_sensitivity.n_axes": "2", "koksma_integral_component.n_axes": "2", "koksma_integral_sensitivity.samples": "16",
    "koksma_screen_options *": "screen_options()", "koksma_screen_row *": "a_buffer(2 * sizeof(koksma_screen_row))",
    "koksma_screen_errors.pattern": "a_pattern(\"gaussian-jittered:sigma=0.2\")",
    "koksma_integration_errors.pattern": "a_pattern(\"gaussian-jittered:sigma=0.2\")",
    "koksma_estimator_find.name": "\"mean\"", "koksma_interval_find.name": "\"student\"", "koksma_integral_estimate *": "a_buffer(sizeof(koksma_integral_estimate))",
    "koksma_estimate_options *": "a_zero(sizeof(koksma_estimate_options))", "koksma_estimate_integral.n": "16", "koksma_estimate_integral.values": "a_buffer(16 * sizeof(double))",
    "koksma_values_of *": "first_coordinates", "koksma_integrate_to.context": "NULL", "koksma_values_by_command.context": "values_command()", "koksma_integrate_to.dim": "2", "koksma_integrate_to.pattern": "a_pattern(\"random\")",
    "koksma_tolerance_options *": "tolerance_options()", "koksma_tolerance *": "a_buffer(sizeof(koksma_tolerance))",
    "koksma_audit_options *": "audit_options()", "koksma_audit *": "a_buffer(sizeof(koksma_audit))",
    "koksma_rank_picture *": "a_rank_picture()", "koksma_scene_search *": "scene_search()",
    "koksma_scene_optimum *": "a_buffer(sizeof(koksma_scene_optimum))", "koksma_scene_optimum_fini.best": "a_zero(sizeof(koksma_scene_optimum))",
    "koksma_rank_by_command.context": "a_copy(\"printf 'Pf\\n1 1\\n-1\\nabcd' >{out.pfm}\", 35)",
    "koksma_rank_by_command.image": "a_buffer(sizeof(koksma_image))",
    "koksma_rank_process_by_command.context": "a_copy(\"cp {in.pfm} {out.pfm}\", 22)",
    # Inline functions.
    "koksma_domain": "{7}", "koksma_sobol *": "a_sequence()", "koksma_keys *": "some_keys()", "koksma_keys_of.pair": "0", "koksma_keys_of_4d.quadruple": "0", "uint32_t": "1", "const uint32_t *": "a_buffer(3 * sizeof(uint32_t))",
    "int": "1", "koksma_permute.n": "8", "koksma_cmj_2d.columns": "4", "koksma_cmj_2d.rows": "4", "koksma_mask_value.pixels": "16",
    "koksma_mask_2d.spp": "4", "koksma_part_of_sample.s": "0", "float *": "a_buffer(4 * sizeof(float))", "koksma_domain *": "a_buffer(sizeof(koksma_domain))",
    "koksma_findings_fini.findings": "a_zero(sizeof(koksma_findings))", "koksma_identities_fini.identities": "a_zero(sizeof(koksma_identities))",
}

# Members of the library's tables, which are constant: a copy of one, with one pointer NULL, must not crash a call.
TABLES = {"koksma_adaptive", "koksma_estimator", "koksma_filter", "koksma_integrand", "koksma_integrator", "koksma_interval", "koksma_mask_space", "koksma_measure", "koksma_metric", "koksma_param", "koksma_pattern", "koksma_warp"}
# Structs that a function only writes: what is in them before the call means nothing.
RESULTS = re.compile(r"_(audit|optimum|entry|tally|value|line|values|error|report|summary|cost|row|ranking|findings|ring|facts|integration|sensitivity|result|quality|estimate|tolerance|replicates)$")
WRONG = {
    "size_t": ["0", "SIZE_MAX", "SIZE_MAX / 2 + 1"], "int": ["0", "-1", "INT_MIN", "INT_MAX"],
    "long long": ["-1", "LLONG_MIN", "LLONG_MAX"], "uint64_t": ["0", "UINT64_MAX"],
    "uint32_t": ["0", "UINT32_MAX", "1u << 31"], "double": ["NAN", "INFINITY", "-INFINITY", "-1", "0", "1e308"],
    "float": ["NAN"], "_Bool": [], "unsigned int": ["0", "UINT_MAX"],
    "const char *": ["NULL", "\"\"", "long_text()", "\"/dev/null/x\"", "\"%s%n \\xff\\x1b\\n\"", "\"nothing:of=this,kind\""],
}

# What a text may call an argument, beside its name and that of the struct's member.
SYNONYMS = {"params": ["takes"], "sampler": ["pattern"], "n": ["point", "points", "panels", "layers"], "width": ["pixels"], "height": ["pixels"],
            "size": ["bytes"], "n_sizes": ["sizes"], "sizes": ["prefixes"], "n_uses": ["uses"], "uses": ["use"], "n_plans": ["results"], "folder": ["folder"], "places": ["path"], "xs": ["point", "points", "coordinate"], "dim": ["dimensions", "dimensional"],
            "x": ["corner"], "path": ["characters"], "text": ["plan"]}


def words(label):
    """The words of which an error's text must have one."""
    parts = re.findall(r"[a-z]\w*", label)
    return "|".join(dict.fromkeys(parts + [word for part in parts for word in SYNONYMS.get(part, [])]))


# Values that the headers allow, or whose wrongness nobody can see: "FUNCTION PLACE = VALUE".
ALLOWED = [
    r"\w+ (run|comment|metadata|left_out) = .*", r"koksma_scene_set_sky (image = NULL|radiance = 0)", r"\w+_(fini|close) \w+ = NULL", r"\w+ (summary|report) = NULL",
    r"\w+ run->(threads = (0|INT_MAX)|time_limit_s = (INFINITY|0|1e308)) .*", r"\w+ seed = .*",
    # A pattern has no measure, a measure no pattern; the path is of patterns that read a file, which have no parameters.
    r"\w+ (spec|pattern)->measure = NULL .*", r"\w+ (spec|measure)->pattern = NULL .*l2-disk.*", r"\w+ measure->pattern = NULL .*",
    r"\w+ \w+->path = .*(l2-disk|edge).*", r"\w+ \w+->params.* = 0 .*", r"\w+ \w+->params.*file:.*",
    r"koksma_integral_of_function function->(name = \"[/%n]|max_dim = INT_MAX).*", r"koksma_integral_sensitivity samples = 0.*",
    r"koksma_integration_summary (value|variance|estimates|options->sizes).*", r"koksma_integration_(errors|summary) options->tests .*",
    r"koksma_generate_(range|write) first = 0.*", r"koksma_generate_rectangle (map = NULL|(width|height) = (2|5)) .*", r"koksma_generate_range n = UINT64_MAX.*", # of a sequence n is unused
    r"koksma_generate_whole dim = 0 .*", r"koksma_local_discrepancy x\[0\] = 0 .*", r"\w+ n_sizes = 0 .*",
    r"koksma_warp_evaluate measure->params.*", r"\w+ (options->witness->|panels->scatter\.)(dim|count|columns|rows) = .*",
    r"koksma_plot_panels panels->spectrum = NULL .*", r"\w+ chart->curves->(xs|ys|errors|colour).*(\d|NAN|X|INFINITY|2 \+ 1) a_chart.*",
    r"\w+ \S*->level = .*", r"\w+ layers->name = .*", r"\w+ coherence->images = .*", r"\w+ options->(x_label|y_label).*",
    r"koksma_render_patterns options->.*", r"\w+ options->(patterns|groups).*\(\"gaussian-jittered(:shift=1)?\"\)",
    r"\w+ options->(pattern|patterns\[0\]|groups\[0\]\.pattern)\.(measure = NULL|path|params\[0\] = 0) .*", r"\w+ options->patterns\[0\]\.pattern = NULL .*",
    r"\w+ options->groups\[0\]\.(n_uses = 0|uses\[0\] = 0|pattern\.params.*) .*", r"\w+ options->depth = (0|-1) .*", r"\w+ options->pattern\.params.*random;.*",
    r"koksma_plot_(panels|chart|figure) \S*( \*\)\S*)?(title|caption|swatch|row) = .*",
    r"koksma_plot_figure .*(scatter\.(columns|rows|warp|witness)|panel\)->spectrum|cells->chart) = (0|NULL).*",
    r"koksma_plot_scatter options = NULL .*", r"\w+ options->seed = .*", r"koksma_render_adaptive adaptive->probes = 0 .*",
    r"koksma_study_open options->(folder = NULL|trials = LLONG_MAX) .*", r"koksma_study_table_row i = .*",
    r"koksma_rank_patterns options->(width = 0|height = 0|integrator = NULL|filter = NULL|adaptive = NULL|metric = NULL|time_limit_s = (INFINITY|0|1e308)) .*",
    r"\w+ spectrum->sets = .*", r"koksma_image_check_finite name = .*", r"\w+ options->caption.*", r"\w+ \S*(caption|label) = .*",
    r"\w+ options->(columns|rows) = 0 .*", r"\w+ \S*(size|white|level|errors|warp|witness|splits|strata|aovs|curves) = (0|NULL) .*", r"\w+ \S*n(_splits|_curves)? = 0 .*",
    r"koksma_study_images folder = NULL .*", r"koksma_closest_name table = NULL.*", r"koksma_optimise options->first = NULL .*", r"koksma_optimise options->first.*absent.*",
    r"koksma_study_audit options->(rows = LLONG_MAX|rows = 0|differs.*) .*", r"koksma_text_escape (size|text) = .*", r"koksma_optimise options->(steps|seed|first) = .*",
    r"koksma_optimise options->(projections = NULL|n_projections = 0|weights = NULL|processes = NULL|power = NULL|rings = 0) .*",
    r"koksma_rank_by_command picture->(scene|pattern) = (\"|long_text).*", r"koksma_rank_by_command picture->(spp|width|height|seed) = .*",  # its affair
    r"koksma_rank_to_error options->(width = 0|height = 0|integrator = NULL|filter = NULL|adaptive = NULL|metric = NULL|time_limit_s = (INFINITY|0|1e308)) .*",
    r"koksma_rank_to_error (target = 1e308|options->(spp|max_trials) = ).*",
    r"koksma_rank_(patterns|to_error) options->(render|render_context|reference|reference_image|process|process_context|variant) = .*",
    r"koksma_optimise_scene options->(candidates|phases|n_held_out|held_out|against) = (0|NULL) .*",
    r"koksma_datasheet options->(beside = NULL|scenes = NULL|n_beside = 0|n_scenes = 0|metric = NULL) .*",
    r"koksma_estimate_integral values.*",
    r"koksma_(estimate_integral|integrate_to) options->\S*(estimator|interval) = NULL .*", r"koksma_integrate_to options->(seed|replicates = 0|first_n = 0|most_points) .*",
    r"koksma_integrate_to options->most_points = .*", r"koksma_integrate_to pattern->(params|path|modifiers|measure).*",
    r"koksma_study_images metric = NULL .*", r"koksma_image_blur sd = 0 .*", r"koksma_plan_write made = NULL .*",
    r"koksma_mask_\w+ (space|options->space|options->from|filter|from|result) = .*", r"koksma_mask_\w+ options->(levels|done) = 0 .*", r"koksma_mask_\w+ bits = 0.*", r"koksma_mask_rings anisotropy = NULL.*",
    r"koksma_mask_write_recipe options->(levels|done|from) = .*",
    r"(\w+ path|koksma_plan_write folder) = .(%s%n|nothing:of).*",  # names of files like others
]

headers = sorted(name for name in os.listdir(os.path.join(include, "koksma")) if name.endswith(".h"))
source = "".join(f"#include <koksma/{name}>\n" for name in headers)
tree = json.loads(subprocess.run([clang, "-x", "c", "-std=c11", "-I", include, "-Xclang", "-ast-dump=json", "-fsyntax-only",
                                  "-"], input=source, capture_output=True, text=True, check=True).stdout)
functions, structs, enums = [], {}, set()
for node in tree["inner"]:
    if node["kind"] == "FunctionDecl" and re.match("koksma_[^_]", node["name"]):
        functions.append(node)
    elif node["kind"] == "RecordDecl" and "name" in node and node.get("completeDefinition"):
        structs[node["name"]] = [(f["name"], f["type"]["qualType"]) for f in node["inner"] if f["kind"] == "FieldDecl"]
    elif node["kind"] == "EnumDecl" and "name" in node:
        enums.add(node["name"])


def plain(kind):
    """A type without the const of what its pointer points to and without `struct`, except for numbers and texts."""
    kind = kind.replace("struct ", "").replace("*const", "*").strip()
    target = re.sub(r"^const (koksma_\w+ \*)$", r"\1", kind)
    return {"bool": "_Bool", "_Bool *": "_Bool *"}.get(target, target)


def wrong_members(expression, struct, depth):
    """(place, statement) for each wrong value of each member below a pointer to a struct."""
    for name, kind in structs[struct]:
        yield from wrong_values(f"{expression}->{name}", plain(kind), depth + 1, name)


def wrong_values(place, kind, depth, name):
    """(place, value, statement) for each wrong value of this type at this place."""
    array = re.fullmatch(r"(.*?) ?\[(\d+)\]", kind)
    if array and array[1] == "char":
        yield place, "unterminated", f"memset({place}, 'x', sizeof {place})"
    elif array:
        yield from wrong_values(f"{place}[0]", plain(array[1]), depth, name)
    elif "(*" in kind or kind in ("void *", "const void *"):
        return  # NULL is a valid callback or context
    elif kind in enums:
        for value in ("-1", "999"):
            yield place, value, f"{place} = ({kind}){value}"
    elif kind in WRONG:
        for value in WRONG[kind]:
            if kind == "double" and depth and name not in ("params", "time_limit_s"):
                value = f"(double){value}"  # of a struct: a number that is wrong gives a wrong result, and no error
            yield place, value, f"{place} = {value}"
    elif kind.endswith("*"):
        yield place, "NULL", f"{place} = NULL"
        target = kind[:-1].strip()
        if depth < 3 and target in structs and target not in TABLES and not RESULTS.search(target):
            for inner, value, statement in wrong_members(f"((koksma_{target[7:]} *){place})", target, depth):
                yield inner, value, f"if ({place}) {statement}; else absent()"
        elif depth < 3 and target in TABLES:
            for member, member_kind in structs[target]:
                if "*" in member_kind:
                    inner = f"((koksma_{target[7:]} *){place})->{member}"
                    yield inner, "NULL", (f"if ({place}) {{ {place} = a_copy({place}, sizeof *{place}); "
                                          f"{inner} = NULL; }} else absent()")
        elif target == "const double" and depth < 3:
            for value in WRONG["double"]:
                yield f"{place}[0]", value, f"if ({place}) (({target[6:]} *){place})[0] = {value}; else absent()"
        elif target == "const size_t":
            for value in WRONG["size_t"]:
                yield f"{place}[0]", value, f"((size_t *){place})[0] = {value}"
    elif kind in structs:
        for inner, inner_kind in structs[kind]:
            yield from wrong_values(f"{place}.{inner}", plain(inner_kind), depth, inner)


def valid(function, name, kind):
    """The valid arguments for a parameter, as a list."""
    for key in (f"{function}.{name}", f"{name}:{kind}", kind):
        if key in VALID:
            return VALID[key] if isinstance(VALID[key], list) else [VALID[key]]
    sys.exit(f"misuse.py: no valid argument for {function}({kind} {name}): add it to VALID in {__file__}")


def write_function(node, lines):
    """The function that makes one call of a public function, with or without something wrong."""
    name, inline = node["name"], node.get("storageClass") == "static"
    result = plain(node["type"]["qualType"].split("(")[0].strip())
    parameters = [(p["name"], p["type"]["qualType"], plain(p["type"]["qualType"])) for p in node.get("inner", [])
                  if p["kind"] == "ParmVarDecl"]
    kinds = {p: k for p, _, k in parameters}
    cases = []
    for parameter, _, kind in parameters:
        for variant, expression in enumerate(valid(name, parameter, kind)):
            if variant:
                cases.append((parameter, expression, f"{parameter} = {expression}", "VALID", (parameter, variant)))
            for place, value, statement in wrong_values(parameter, kind, 0, parameter):
                if inline and (value == "NULL" or parameter == "count" and kind == "uint32_t" and "sobol" in name):
                    continue  # what nobody can see: a pointer's target, and how long an array is
                if expression.startswith(("a_buffer", "a_zero")) and place != parameter:
                    continue  # a result, or nothing to look at
                if not (variant and place == parameter) and not (expression == "NULL" and place != parameter):
                    cases.append((place, value, statement, parameter, (parameter, variant)))
    lines.append(f"static bool call_{name}(size_t case_)\n{{")
    for parameter, _, kind in parameters:
        shown = kind.replace("_Bool", "bool")
        lines.append(f"    {shown} {parameter} = {'(void *)' if kind.endswith('*') and 'char' not in kind else ''}{valid(name, parameter, kind)[0]};")
    lines.append(f"    switch (case_) {{\n    case 0: valid_call(\"{name}\", \"\"); break;")
    for index, (place, value, statement, parameter, (of, variant)) in enumerate(cases, 1):
        base = f"{of} = (void *){valid(name, of, kinds[of])[variant]}; " if variant else ""
        if parameter == "VALID":
            shown = value.replace('"', "'")
            lines.append(f"    case {index}: {base}valid_call(\"{name}\", \"{shown}\"); break;")
            continue
        label = re.sub(r"\(\(koksma_\w+ \*\)([^()]*)\)", r"\1", re.sub(r"\(\(koksma_\w+ \*\)([^()]*)\)", r"\1", place))
        shown = value.replace("\\", "\\\\").replace('"', "'")
        kind = f"any_call(\"{name}\", \"{label}\", \"{shown}\")"
        case = f"{name} {label} = {value} {valid(name, of, kinds[of])[variant]}"
        optional = "= a_copy(" in statement  # not every function needs every member: test_arguments.c has those it needs
        strict = not optional and not inline and result == "koksma_status" and not value.startswith("(double)") or value == "NULL" and place == of
        if strict and not any(re.fullmatch(rule, case) or re.fullmatch(rule, f"{name} {label} = {value}") for rule in ALLOWED):
            kind = f"wrong_call(\"{name}\", \"{label}\", \"{shown}\", \"{words(label)}\")"
        lines.append(f"    case {index}: {base}{statement}; {kind}; break;")
    lines.append("    default: return false;\n    }")
    for parameter, declared, kind in parameters:
        target = kind[:-1].strip() if kind.endswith("*") else ""
        if target and not declared.startswith("const") and (target in structs or target.endswith("*") or target in ("double", "size_t", "_Bool", "koksma_plot_format")):
            lines.append(f"    watch(\"{parameter}\", {parameter}, sizeof *{parameter});")
    call = f"{name}({', '.join(p for p, _, _ in parameters)})"
    if result == "void":
        lines.append(f"    {call};\n    void_returned();")
    elif result == "koksma_status":
        lines.append(f"    status_returned({call});")
    elif result in structs:
        lines.append(f"    const {result} result = {call};\n    struct_returned(&result, sizeof result);")
    elif result.endswith("*"):
        lines.append(f"    pointer_returned({call});")
    else:
        lines.append(f"    number_returned((double){call});")
    lines.append("    return true;\n}\n")


text = ["/* Made from the headers by tests/api/misuse.py. */\n"]
for node in functions:
    write_function(node, text)
text.append("static const struct {\n    const char *name;\n    bool (*call)(size_t k);\n} calls[] = {")
text += [f"    {{\"{node['name']}\", call_{node['name']}}}," for node in functions]
text.append("};\n")
with open(out, "w", encoding="ascii") as file:
    file.write("\n".join(text))
