// SPDX-License-Identifier: Apache-2.0

/** The library's own line of text about what is wrong. */
export class KoksmaError extends Error {}

/** n points of dim coordinates in [0,1): coordinate k of point i is xs[i * dim + k]. */
export interface Points {
  xs: Float64Array | number[];
  n: number;
  dim: number;
}

export interface GeneratedPoints extends Points {
  xs: Float64Array;
  /** The canonical spec: the parameters that differ from their defaults, in table order. */
  spec: string;
}

/** The region that proves a value: counting its points gives it. */
export interface Witness {
  kind: "box" | "half-plane" | "disk";
  closed: boolean;
  count: number;
  volume: number;
  lo: number[];
  hi: number[];
}

export interface Value {
  /** The canonical spec of the measure. */
  measure: string;
  value: number | null;
  /** The value as the program prints it, to 9 digits. */
  value_text: string;
  /** Of a sampled measure; 0 for others, null with one sample. */
  standard_error: number | null;
  exact: boolean;
  witness: Witness | null;
}

export interface Finding {
  property: string;
  /** The coordinates ("0,1", "all") or cells ("4 x 8") that were tested, or "-". */
  subject: string;
  holds: boolean;
  value: number | null;
  detail: string;
}

export interface Parameter {
  name: string;
  help: string;
  fallback: number;
  min: number;
  max: number;
  whole: boolean;
  choices: string[] | null;
}

export interface PatternInfo {
  name: string;
  title: string;
  cite: string;
  min_dim: number;
  max_dim: number;
  /** [name, meaning] of what the pattern claims. */
  claims: [string, string][];
  takes_path: boolean;
  alias_of: string;
  params: Parameter[];
}

export interface MeasureInfo {
  name: string;
  title: string;
  cite: string;
  min_dim: number;
  max_dim: number;
  family: number;
  exact: boolean;
  larger_is_better: boolean;
  cost: string;
  params: Parameter[];
}

/** A whole number from 0 to 2^53 - 1, or a BigInt below 2^64. */
export type Key = number | bigint;

/** Every function throws a KoksmaError. None shares state with another instance; a worker opens its own. */
export interface Koksma {
  tables(): { version: string; max_spec: number; patterns: PatternInfo[]; measures: MeasureInfo[]; integrands: { name: string; title: string }[] };
  /** The points of a pattern, such as "sobol:scramble=owen": bit for bit those of the program. */
  generate(spec: string, options: { n: number; dim?: number; seed?: Key }): GeneratedPoints;
  /** A measure of points, such as "star" or "disk:r=0.1". */
  measure(points: Points, measure: string): Value;
  /** The properties of points: nets, strata, distances. */
  verify(points: Points): Finding[];
  /** The points as a .csv file. */
  csv(points: Points): string;
  /** A void-and-cluster mask: size * size ranks, row after row; size from 4 to 1024. */
  mask(size: number, options?: { seed?: Key }): Uint32Array;
  /** Keys of domains for samples, as in koksma/sampler.h. */
  domainOfPixel(seed: Key, x: number, y: number): bigint;
  domainOfUse(key: Key, use: number): bigint;
  domainOfSample(key: Key, i: number): bigint;
  seedOfFrame(seed: Key, frame: number): bigint;
  /** Samples first .. first + count - 1 of a domain. "sobol" and "white" have 1 to 4 dimensions, "pmj02" has 2. */
  samples(sampler: "sobol" | "pmj02" | "white", key: Key, options: { first?: number; count: number; dim?: number }): Float64Array;
  /** After a trap, such as one for memory, makes the instance usable again. */
  reopen(): Promise<void>;
}

/** A new instance, of the package's own file or of a WebAssembly.Module that a bundler or another thread gives. */
export function open(module?: WebAssembly.Module): Promise<Koksma>;

/** One instance that all callers of this thread share. */
export function koksma(): Promise<Koksma>;
