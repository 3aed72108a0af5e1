# SPDX-License-Identifier: Apache-2.0
"""The structs of the public headers, member for member. tests/python/test_structs.py compares them with the C
compiler's."""
from ctypes import (CFUNCTYPE, POINTER, Structure, c_bool, c_char, c_char_p, c_double, c_float, c_int, c_longlong,
                    c_size_t, c_uint, c_uint32, c_uint64, c_void_p, sizeof)

MAX_PARAMS, MAX_MODIFIERS, MAX_SPEC, WITNESS_DIM, N_USES = 8, 8, 512, 16, 9
MAX_USE_GROUPS = N_USES // 2
MAX_DIM, MAX_COORDINATES, MAX_HALF = 4096, 1 << (28 if sizeof(c_size_t) > 4 else 24), 4096
MAX_SPP, MAX_IMAGE_SIDE, MAX_DEPTH = 1 << 20, 65536, 64
MAX_RANK_TRIALS, RANK_CHECKS, RANK_REASON = 65536, 2, 256
MAX_SIZES, MAX_STEPS = 64, 32
MASK_MIN, MASK_MAX, MASK_MAX_SIDE = 4, 1024, 65
MAX_INT, MAX_SEED, MAX_INDEX = (1 << 31) - 1, (1 << 64) - 1, (1 << 51) - 1

KeepGoing = CFUNCTYPE(c_bool, c_void_p, c_double)


class Points(Structure):
    _fields_ = [("n", c_size_t), ("dim", c_int), ("xs", POINTER(c_double))]


class Param(Structure):
    _fields_ = [("name", c_char_p), ("help", c_char_p), ("fallback", c_double), ("min", c_double), ("max", c_double),
                ("choices", POINTER(c_char_p)), ("whole", c_bool)]


class Run(Structure):
    _fields_ = [("threads", c_int), ("time_limit_s", c_double), ("keep_going", KeepGoing), ("context", c_void_p)]


class Pacing(Structure):
    _fields_ = [("keep_going", KeepGoing), ("context", c_void_p), ("interval_s", c_double), ("next_s", c_double),
                ("stopped", c_bool)]


class Pattern(Structure):
    _fields_ = [("name", c_char_p), ("title", c_char_p), ("cite", c_char_p), ("min_dim", c_int), ("max_dim", c_int),
                ("claims", c_uint), ("params", POINTER(Param)), ("generate", c_void_p), ("operand", c_char_p),
                ("alias_of", c_char_p), ("whole", c_void_p), ("revision", c_int), ("ranges", c_void_p),
                ("runs_code", c_bool)]


class Modifier(Structure):
    _fields_ = [("name", c_char_p), ("title", c_char_p), ("cite", c_char_p), ("min", c_double), ("max", c_double), ("random", c_bool),
                ("claims", c_uint), ("claims_binary", c_uint), ("gives", c_uint), ("measures", c_char_p), ("keeps", c_char_p)]


class Measure(Structure):
    _fields_ = [("name", c_char_p), ("title", c_char_p), ("cite", c_char_p), ("cost", c_char_p), ("family", c_int), ("min_dim", c_int),
                ("max_dim", c_int), ("params", POINTER(Param)), ("eval", c_void_p), ("answer", c_int), ("larger_is_better", c_bool),
                ("revision", c_int), ("on_torus", c_bool), ("gradient", c_void_p)]


class Spec(Structure):
    _fields_ = [("pattern", POINTER(Pattern)), ("measure", POINTER(Measure)), ("params", c_double * MAX_PARAMS),
                ("path", c_char * MAX_SPEC), ("modifiers", c_double * MAX_MODIFIERS)]


class Witness(Structure):
    _fields_ = [("kind", c_int), ("dim", c_int), ("closed", c_bool), ("count", c_size_t), ("volume", c_double),
                ("lo", c_double * WITNESS_DIM), ("hi", c_double * WITNESS_DIM)]


class Value(Structure):
    _fields_ = [("value", c_double), ("square", c_double), ("lower", c_double), ("upper", c_double),
                ("standard_error", c_double), ("exact", c_bool), ("witness", Witness)]


class Finding(Structure):
    _fields_ = [("property", c_char_p), ("subject", c_char * 48), ("holds", c_bool), ("value", c_double),
                ("detail", c_char * 200)]


class Findings(Structure):
    _fields_ = [("count", c_size_t), ("capacity", c_size_t), ("items", POINTER(Finding))]


class Identity(Structure):
    _fields_ = [("relation", c_char_p), ("what", c_char * 160), ("spec", c_char * 512), ("first", c_uint64),
                ("seed", c_uint64), ("detail", c_char * 400)]


class Identities(Structure):
    _fields_ = [("count", c_size_t), ("capacity", c_size_t), ("items", POINTER(Identity))]


class Optimum(Structure):
    _fields_ = [("points", Points), ("value", c_double), ("lower", c_double), ("steps", c_uint64),
                ("last_gain", c_uint64), ("method", c_char_p)]


OptimiseProgress = CFUNCTYPE(c_bool, c_void_p, POINTER(Optimum))


class OptimiseOptions(Structure):
    _fields_ = [("n", c_size_t), ("dim", c_int), ("first", POINTER(Points)), ("keep", c_int), ("seed", c_uint64),
                ("steps", c_uint64), ("progress", OptimiseProgress), ("context", c_void_p),
                ("projections", POINTER(c_uint64)), ("weights", POINTER(c_double)), ("n_projections", c_size_t),
                ("power", POINTER(c_double)), ("rings", c_int)]


class Spectrum(Structure):
    _fields_ = [("half", c_int), ("sets", c_size_t), ("points", c_double), ("power", POINTER(c_double)),
                ("rings", c_void_p)]


class SpectrumQuality(Structure):
    _fields_ = [("effective_nyquist", c_double), ("relative_nyquist", c_double), ("oscillation", c_double)]


class Ring(Structure):
    _fields_ = [("frequency", c_double), ("power", c_double), ("standard_error", c_double),
                ("anisotropy_db", c_double)]


class Image(Structure):
    _fields_ = [("width", c_int), ("height", c_int), ("channels", c_int), ("pixels", POINTER(c_float))]


class MaskSpace(Structure):
    _fields_ = [("name", c_char_p), ("title", c_char_p), ("dim", c_int), ("low", c_double), ("high", c_double)]


class MaskFilter(Structure):
    _fields_ = [("width", c_int), ("height", c_int), ("weights", c_double * (MASK_MAX_SIDE * MASK_MAX_SIDE))]


class MaskOptions(Structure):
    _fields_ = [("width", c_int), ("height", c_int), ("space", POINTER(MaskSpace)), ("filter", MaskFilter), ("open", c_bool),
                ("levels", c_int), ("seed", c_uint64), ("swaps", c_double), ("from", POINTER(c_float)), ("done", c_uint64),
                ("first", c_double), ("state", POINTER(c_uint32)), ("target", c_double)]


class MaskQuality(Structure):
    _fields_ = [("error", c_double), ("white", c_double), ("inside", c_double), ("seam", c_double)]


class Mask(Structure):
    _fields_ = [("width", c_int), ("height", c_int), ("space", POINTER(MaskSpace)), ("values", POINTER(c_float))]


class ImageError(Structure):
    _fields_ = [("mean", c_double), ("sd", c_double), ("max", c_double), ("rmse", c_double)]


class MetricSpec(Structure):
    _fields_ = [("metric", c_void_p), ("params", c_double * MAX_PARAMS)]


class MetricValue(Structure):
    _fields_ = [("value", c_double), ("robust", c_double), ("top_share", c_double), ("top", c_size_t), ("caveat", c_char_p)]


class Coherence(Structure):
    _fields_ = [("width", c_int), ("height", c_int), ("images", c_size_t), ("error", POINTER(c_double)),
                ("power", POINTER(c_double)), ("squares", POINTER(c_double))]


class CoherenceValues(Structure):
    _fields_ = [("images", c_size_t), ("coherence", c_double), ("low", c_double), ("high", c_double),
                ("frequency_x", c_double), ("frequency_y", c_double), ("common", c_double), ("noise_low", c_double),
                ("noise_high", c_double), ("p", c_double), ("coherent", c_bool)]
class Line(Structure):
    _fields_ = [("count", c_size_t), ("slope", c_double), ("slope_error", c_double), ("intercept", c_double)]


FunctionAt = CFUNCTYPE(c_double, POINTER(c_double), c_int, c_void_p)


class Integrand(Structure):
    _fields_ = [("name", c_char_p), ("title", c_char_p), ("cite", c_char_p), ("known", c_char_p), ("min_dim", c_int),
                ("max_dim", c_int), ("axes", c_int), ("params", POINTER(Param)), ("prepare", c_void_p), ("at", c_void_p),
                ("constants", c_void_p), ("revision", c_int)]


class Function(Structure):
    _fields_ = [("name", c_char_p), ("min_dim", c_int), ("max_dim", c_int), ("at", FunctionAt), ("context", c_void_p),
                ("integral", c_double)]


class IntegralFacts(Structure):
    _fields_ = [("text", c_char * MAX_SPEC), ("dim", c_int), ("axes", c_int), ("value", c_double), ("variance", c_double),
                ("variation", c_double), ("lowest", c_double), ("highest", c_double)]


class IntegrationRow(Structure):
    _fields_ = [("n", c_size_t), ("trials", c_uint64), ("mean", c_double), ("sd", c_double), ("rmse", c_double),
                ("low", c_double), ("high", c_double), ("gain", c_double), ("z", c_double),
                ("approximate", c_bool)]


class IntegrationSlope(Structure):
    _fields_ = [("count", c_size_t), ("value", c_double), ("standard_error", c_double), ("low", c_double), ("high", c_double),
                ("approximate", c_bool)]


class Integration(Structure):
    _fields_ = [("rows", IntegrationRow * MAX_SIZES), ("slope", IntegrationSlope), ("bias", c_char * 200)]


class IntegrationOptions(Structure):
    _fields_ = [("sizes", c_size_t * MAX_SIZES), ("n_sizes", c_size_t), ("seed", c_uint64), ("trials", c_uint64), ("tests", c_size_t)]


class ScreenOptions(Structure):
    _fields_ = [("dim", c_int), ("side", c_int), ("spp", c_size_t), ("filter", MaskFilter), ("seed", c_uint64), ("trials", c_uint64)]


class ScreenRow(Structure):
    _fields_ = [("coordinates", c_int), ("plain", c_double), ("plain_error", c_double), ("blurred", c_double), ("blurred_error", c_double)]


class Estimator(Structure):
    _fields_ = [("name", c_char_p), ("title", c_char_p), ("cite", c_char_p), ("interval", c_char_p), ("of", c_void_p)]


class Interval(Structure):
    _fields_ = [("name", c_char_p), ("title", c_char_p), ("cite", c_char_p), ("estimator", c_char_p), ("assumes", c_char_p),
                ("proved", c_bool), ("bounded", c_bool)]


class EstimateOptions(Structure):
    _fields_ = [("estimator", c_char_p), ("interval", c_char_p), ("confidence", c_double), ("lowest", c_double), ("highest", c_double),
                ("share", c_double)]


class IntegralEstimate(Structure):
    _fields_ = [("value", c_double), ("low", c_double), ("high", c_double), ("error", c_double), ("confidence", c_double),
                ("estimator", c_char_p), ("interval", c_char_p)]


ValuesOf = CFUNCTYPE(c_int, c_void_p, POINTER(Points), POINTER(c_double))


class ToleranceOptions(Structure):
    _fields_ = [("estimate", EstimateOptions), ("absolute", c_double), ("relative", c_double), ("replicates", c_size_t),
                ("first_n", c_size_t), ("most_points", c_uint64), ("seed", c_uint64), ("resume", c_char_p), ("function", c_char_p)]


class ToleranceStep(Structure):
    _fields_ = [("n", c_size_t), ("points", c_uint64), ("estimate", IntegralEstimate)]


class Tolerance(Structure):
    _fields_ = [("reached", c_bool), ("parts", c_bool), ("replicates", c_size_t), ("n_steps", c_size_t), ("steps", ToleranceStep * MAX_STEPS), ("rate", c_double),
                ("rate_error", c_double), ("needed", c_double), ("needed_low", c_double), ("needed_high", c_double),
                ("least", c_double), ("largest", c_double), ("top_share", c_double)]


class ScatterOptions(Structure):
    _fields_ = [("size", c_double), ("columns", c_size_t), ("rows", c_size_t), ("local_discrepancy", c_bool), ("warp", c_void_p),
                ("witness", POINTER(Witness)), ("caption", c_char_p)]


class Panel(Structure):
    _fields_ = [("points", POINTER(Points)), ("scatter", ScatterOptions), ("spectrum", POINTER(Spectrum)), ("white", c_double),
                ("caption", c_char_p), ("title", c_char_p), ("swatch", c_size_t)]


class Curve(Structure):
    _fields_ = [("label", c_char_p), ("n", c_size_t), ("xs", POINTER(c_double)), ("ys", POINTER(c_double)),
                ("errors", POINTER(c_double)), ("marks", c_bool), ("dashed", c_bool), ("colour", c_size_t)]


class Chart(Structure):
    _fields_ = [("x_label", c_char_p), ("y_label", c_char_p), ("log_x", c_bool), ("log_y", c_bool), ("curves", POINTER(Curve)),
                ("n_curves", c_size_t), ("has_level", c_bool), ("level", c_double), ("title", c_char_p)]


class Cell(Structure):
    _fields_ = [("panel", POINTER(Panel)), ("chart", POINTER(Chart)), ("row", c_size_t)]


class Figure(Structure):
    _fields_ = [("title", c_char_p), ("cells", POINTER(Cell)), ("n_cells", c_size_t), ("width", c_double), ("height", c_double),
                ("wrap", c_bool), ("dark", c_bool)]


class StudyOptions(Structure):
    _fields_ = [("plans", POINTER(c_char_p)), ("n_plans", c_size_t), ("folder", c_char_p), ("trials", c_longlong),
                ("quick", c_bool)]


class StudySummary(Structure):
    _fields_ = [("jobs", c_size_t), ("done_before", c_size_t), ("done_now", c_size_t), ("workers", c_int), ("seconds", c_double),
                ("idle_seconds", c_double), ("processor_seconds", c_double), ("store_seconds", c_double), ("complete", c_bool)]


class StudyRow(Structure):
    _fields_ = [("pattern", c_char_p), ("label", c_char_p), ("n", c_longlong), ("published", c_double * 3), ("mean", c_double),
                ("low", c_double), ("high", c_double), ("sd", c_double), ("max", c_double), ("converged", c_double),
                ("trials", c_size_t), ("verdict", c_int)]


Differs = CFUNCTYPE(None, c_void_p, c_char_p)


class AuditOptions(Structure):
    _fields_ = [("folder", c_char_p), ("rows", c_longlong), ("seed", c_uint64), ("differs", Differs), ("context", c_void_p)]


class Audit(Structure):
    _fields_ = [("rows", c_longlong), ("other_rows", c_longlong), ("drawn", c_longlong), ("agree", c_longlong),
                ("bound", c_double), ("references", c_size_t), ("references_agree", c_size_t),
                ("references_missing", c_size_t),
                ("differences", c_size_t), ("rows_missing", c_longlong)]


class UseGroup(Structure):
    _fields_ = [("pattern", Spec), ("n_uses", c_int), ("uses", c_int * N_USES)]


class RenderOptions(Structure):
    _fields_ = [("pattern", Spec), ("patterns", Spec * N_USES), ("groups", UseGroup * MAX_USE_GROUPS), ("spp", c_int), ("width", c_int),
                ("height", c_int), ("seed", c_uint64), ("pairing", c_int), ("scope", c_int), ("lights", c_int), ("integrator", c_void_p),
                ("depth", c_int), ("filter", c_void_p), ("splat", c_bool)]


class Named(Structure):
    """What a filter, an integrator, a warp, a metric and a method of adaptive sampling begin with."""
    _fields_ = [("name", c_char_p), ("title", c_char_p), ("cite", c_char_p)]


class Layers(Structure):
    _fields_ = [("image", Image), ("albedo", Image), ("normal", Image), ("depth", Image), ("samples", Image),
                ("variance", Image), ("rays", c_uint64)]


class Replicates(Structure):
    _fields_ = [("image", Image), ("error", Image), ("replicates", c_size_t), ("rays", c_uint64), ("mean", c_double),
                ("mean_low", c_double), ("mean_high", c_double), ("rmse", c_double), ("rmse_low", c_double), ("rmse_high", c_double)]


class Adaptive(Structure):
    _fields_ = [*Named._fields_, ("params", POINTER(Param)), ("own_samples", c_bool), ("functions", c_void_p)]


class AdaptiveOptions(Structure):
    _fields_ = [("method", POINTER(Adaptive)), ("params", c_double * MAX_PARAMS), ("budget", c_double), ("probes", c_int),
                ("strata", c_void_p)]


class AdaptiveReport(Structure):
    _fields_ = [("samples", c_uint64), ("first", c_uint64), ("rounds", c_uint64), ("splits", c_uint64), ("needless", c_uint64)]


class RankPicture(Structure):
    _fields_ = [("scene", c_char_p), ("pattern", c_char_p), ("spp", c_int), ("width", c_int), ("height", c_int),
                ("seed", c_uint64)]


NameAt = CFUNCTYPE(c_void_p, c_void_p, c_size_t)
RankDoubt = CFUNCTYPE(None, c_void_p, c_char_p)
RankProcess = CFUNCTYPE(c_int, c_void_p, POINTER(Image), POINTER(Run), POINTER(Image))
RankRenderer = CFUNCTYPE(c_int, c_void_p, POINTER(RankPicture), POINTER(Run), POINTER(Image))


class RankOptions(Structure):
    _fields_ = [("scene", c_char_p), ("patterns", POINTER(c_char_p)), ("n_patterns", c_size_t), ("spp", c_int),
                ("width", c_int), ("height", c_int), ("integrator", c_void_p), ("filter", c_void_p), ("adaptive", c_char_p),
                ("metric", POINTER(MetricSpec)), ("time_limit_s", c_double), ("max_trials", c_longlong), ("one_size", c_bool), ("render", RankRenderer),
                ("render_context", c_void_p), ("reference", c_char_p), ("reference_image", POINTER(Image)), ("process", RankProcess), ("process_context", c_void_p), ("seed", c_uint64),
                ("variant", c_char_p), ("look", c_void_p), ("look_context", c_void_p), ("doubt", RankDoubt), ("doubt_context", c_void_p)]


class SceneCounts(Structure):
    _fields_ = [("shapes", c_size_t), ("meshes", c_size_t), ("placements", c_size_t), ("triangles", c_size_t),
                ("materials", c_size_t), ("lights", c_size_t), ("media", c_size_t), ("paths", c_size_t), ("spp", c_size_t)]


class Record(Structure):
    _fields_ = [("measure", c_char_p), ("n", c_size_t), ("dim", c_int), ("value", c_double), ("published", c_double),
                ("source", c_char_p), ("seed", c_uint64), ("steps", c_uint64)]


class DatasheetOptions(Structure):
    _fields_ = [("sampler", c_char_p), ("beside", POINTER(c_char_p)), ("n_beside", c_size_t),
                ("scenes", POINTER(c_char_p)), ("n_scenes", c_size_t), ("metric", c_char_p), ("quick", c_bool)]


class RankRow(Structure):
    _fields_ = [("pattern", c_size_t), ("position", c_size_t), ("state", c_int), ("decision", c_int), ("biased", c_bool),
                ("trials", c_longlong), ("mean", c_double), ("low", c_double), ("high", c_double),
                ("robust", c_double), ("top_share", c_double), ("behind", c_double), ("behind_low", c_double), ("behind_high", c_double),
                ("coherence", CoherenceValues), ("reason", c_char * RANK_REASON)]


class RankCheckResult(Structure):
    _fields_ = [("state", c_int), ("pattern", c_size_t), ("coherent", c_bool), ("behind", c_double),
                ("behind_low", c_double), ("behind_high", c_double)]


class RankCheck(Structure):
    _fields_ = [("width", c_int), ("height", c_int), ("advice", RankCheckResult), ("first", RankCheckResult),
                ("trials", c_longlong)]


class Ranking(Structure):
    _fields_ = [("n", c_size_t), ("n_slow", c_size_t), ("settled", c_bool), ("complete", c_bool),
                ("cut_short", c_bool), ("trials", c_longlong), ("needed_trials", c_longlong),
                ("undecidable", c_bool), ("needed_s", c_double), ("width", c_int), ("height", c_int),
                ("reference_error", c_double),
                ("checks", RankCheck * RANK_CHECKS), ("seconds", c_double), ("advised", c_bool),
                ("advised_row", c_size_t), ("n_coherent", c_size_t), ("use_row", c_size_t),
                ("within", c_double), ("without_few", c_bool), ("random_spp", c_double), ("random_spp_low", c_double), ("random_spp_high", c_double)]


class TargetRow(Structure):
    _fields_ = [("pattern", c_size_t), ("state", c_int), ("spp", c_int), ("error", c_double), ("low", c_double), ("high", c_double),
                ("needed", c_double), ("needed_low", c_double), ("needed_high", c_double), ("rate", c_double), ("rate_error", c_double),
                ("coherent", c_bool), ("trials", c_longlong), ("reason", c_char * RANK_REASON)]


class TargetRanking(Structure):
    _fields_ = [("width", c_int), ("height", c_int), ("cut_short", c_bool), ("seconds", c_double)]


#: Header, C name and value of the limits above.
CONSTANTS = [
    ("koksma.h", "KOKSMA_MAX_PARAMS", MAX_PARAMS), ("koksma.h", "KOKSMA_MAX_MODIFIERS", MAX_MODIFIERS), ("koksma.h", "KOKSMA_MAX_SPEC", MAX_SPEC),
    ("koksma.h", "KOKSMA_MAX_DIM", MAX_DIM), ("koksma.h", "KOKSMA_MAX_COORDINATES", MAX_COORDINATES),
    ("mask.h", "KOKSMA_MASK_MIN", MASK_MIN), ("mask.h", "KOKSMA_MASK_MAX", MASK_MAX), ("mask.h", "KOKSMA_MASK_MAX_SIDE", MASK_MAX_SIDE),
    ("spectrum.h", "KOKSMA_SPECTRUM_MAX_HALF", MAX_HALF), ("render.h", "KOKSMA_MAX_SPP", MAX_SPP), ("render.h", "KOKSMA_MAX_DEPTH", MAX_DEPTH),
    ("render.h", "KOKSMA_N_USES", N_USES), ("render.h", "KOKSMA_MAX_USE_GROUPS", MAX_USE_GROUPS),
    ("image.h", "KOKSMA_MAX_IMAGE_SIDE", MAX_IMAGE_SIDE), ("koksma.h", "(size_t)INT_MAX", MAX_INT),
    ("study.h", "KOKSMA_MAX_RANK_TRIALS", MAX_RANK_TRIALS), ("study.h", "KOKSMA_RANK_CHECKS", RANK_CHECKS),
    ("study.h", "KOKSMA_RANK_REASON", RANK_REASON),
    ("koksma.h", "UINT64_MAX", MAX_SEED), ("koksma.h", "KOKSMA_MAX_INDEX", MAX_INDEX), ("series.h", "KOKSMA_MAX_SIZES", MAX_SIZES),
    ("estimate.h", "KOKSMA_MAX_STEPS", MAX_STEPS),
]

#: Header, C name and class of every struct above.
LAYOUTS = [
    ("koksma.h", "koksma_points", Points), ("koksma.h", "koksma_param", Param), ("koksma.h", "koksma_run", Run), ("core/parallel.h", "koksma__pacing", Pacing),
    ("koksma.h", "koksma_pattern", Pattern), ("koksma.h", "koksma_measure", Measure),
    ("koksma.h", "koksma_modifier", Modifier), ("koksma.h", "koksma_spec", Spec), ("koksma.h", "koksma_witness", Witness), ("koksma.h", "koksma_value", Value),
    ("mask.h", "koksma_mask_space", MaskSpace), ("mask.h", "koksma_mask_filter", MaskFilter), ("mask.h", "koksma_mask_options", MaskOptions),
    ("mask.h", "koksma_mask_quality", MaskQuality), ("maskfile.h", "koksma_mask", Mask),
    ("verify.h", "koksma_finding", Finding), ("verify.h", "koksma_findings", Findings),
    ("identify.h", "koksma_identity", Identity), ("identify.h", "koksma_identities", Identities),
    ("optimise.h", "koksma_optimum", Optimum), ("optimise.h", "koksma_optimise_options", OptimiseOptions),
    ("integrate.h", "koksma_integrand", Integrand), ("integrate.h", "koksma_function", Function),
    ("integrate.h", "koksma_integral_facts", IntegralFacts), ("integrate.h", "koksma_integration_row", IntegrationRow),
    ("integrate.h", "koksma_integration_slope", IntegrationSlope), ("integrate.h", "koksma_integration", Integration),
    ("integrate.h", "koksma_integration_options", IntegrationOptions), 
    ("integrate.h", "koksma_screen_options", ScreenOptions),
    ("integrate.h", "koksma_screen_row", ScreenRow),
    ("estimate.h", "koksma_estimator", Estimator), ("estimate.h", "koksma_interval", Interval),
    ("estimate.h", "koksma_estimate_options", EstimateOptions), ("estimate.h", "koksma_integral_estimate", IntegralEstimate),
    ("estimate.h", "koksma_tolerance_options", ToleranceOptions), ("estimate.h", "koksma_tolerance_step", ToleranceStep),
    ("estimate.h", "koksma_tolerance", Tolerance),
    ("spectrum.h", "koksma_spectrum", Spectrum),
    ("spectrum.h", "koksma_spectrum_quality_values", SpectrumQuality),
    ("spectrum.h", "koksma_ring", Ring),
    ("image.h", "koksma_image", Image), ("image.h", "koksma_image_error", ImageError),
    ("image.h", "koksma_metric_spec", MetricSpec), ("image.h", "koksma_metric_value", MetricValue),
    ("image.h", "koksma_coherence", Coherence), ("image.h", "koksma_coherence_values", CoherenceValues),
    ("render.h", "koksma_use_group", UseGroup), ("render.h", "koksma_render_options", RenderOptions),
    ("render.h", "koksma_layers", Layers), ("render.h", "koksma_replicates", Replicates), ("adaptive.h", "koksma_adaptive", Adaptive), ("adaptive.h", "koksma_adaptive_options", AdaptiveOptions),
    ("adaptive.h", "koksma_adaptive_report", AdaptiveReport),
    ("series.h", "koksma_line", Line), ("plot.h", "koksma_scatter_options", ScatterOptions), ("plot.h", "koksma_panel", Panel),
    ("plot.h", "koksma_curve", Curve), ("plot.h", "koksma_chart", Chart), ("plot.h", "koksma_cell", Cell),
    ("plot.h", "koksma_figure", Figure), ("study.h", "koksma_study_options", StudyOptions),
    ("study.h", "koksma_study_summary", StudySummary),
    ("study.h", "koksma_study_row", StudyRow), ("study.h", "koksma_audit_options", AuditOptions),
    ("study.h", "koksma_audit", Audit),
    ("datasheet.h", "koksma_datasheet_options", DatasheetOptions),
    ("study.h", "koksma_rank_options", RankOptions), ("study.h", "koksma_rank_row", RankRow),
    ("study.h", "koksma_rank_check_result", RankCheckResult),
    ("study.h", "koksma_rank_check", RankCheck), ("study.h", "koksma_ranking", Ranking),
    ("study.h", "koksma_target_row", TargetRow), ("study.h", "koksma_target_ranking", TargetRanking),
    ("render.h", "koksma_scene_counts", SceneCounts),
    ("optimise.h", "koksma_record", Record),
]
