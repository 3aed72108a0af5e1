-- The results of studies, schema 8 (user_version; application_id 1265333101, "Kksm" in the header of the file). A name
-- in a text never changes its meaning. Numbers are the computed doubles, bit for bit. `SELECT * FROM rows` shows all
-- results with their keys. Koksma opens a file only if it has exactly these tables and nothing else. Table meta also has
-- 'run-folder', the folder in which the last run was started.

CREATE TABLE meta (          -- the file's 'plan', 'plan-texts', 'plan-text-0', 'plan-name-0', ...
  key TEXT PRIMARY KEY,
  value TEXT NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE series (        -- the key of results without the trial; each series is one mean in a table
  id INTEGER PRIMARY KEY CHECK (id BETWEEN 1 AND 67108864),
  kind TEXT NOT NULL CHECK (kind IN ('discrepancy', 'image', 'coherence', 'metric')), -- coherence: of an image's
                                           -- error; metric: an image's error by a metric
  scene TEXT NOT NULL,                     -- '' for discrepancies, as is scene_hash
  scene_hash TEXT NOT NULL,                -- hexadecimal hash of the scene's text, and of a file: pattern's points
  options TEXT NOT NULL,                   -- options that differ from the defaults: pairing=aligned, warp=polar-disk
  pattern TEXT NOT NULL,                   -- canonical spec, e.g. poisson-disk:d=0.2
  n INTEGER NOT NULL CHECK (n > 0),        -- points, or samples per pixel
  dim INTEGER NOT NULL CHECK (dim >= 0),   -- 0 for images
  width INTEGER NOT NULL CHECK (width >= 0), -- 0 for discrepancies, as is height
  height INTEGER NOT NULL CHECK (height >= 0),
  what TEXT NOT NULL,                      -- the measure's canonical spec, or name:pattern@spp x replicates
  metric TEXT NOT NULL CHECK ((metric <> '') = (kind = 'metric')), -- the metric's canonical spec, e.g. relmse
  made_by TEXT NOT NULL,                   -- revisions: renderer 0, n-rooks 0 (src/lab/study/plan/made_by.h)
  measured_by TEXT NOT NULL,               -- revisions of the measure and warp, or of the metric and the
                                           -- reference's generators
  UNIQUE (kind, scene, scene_hash, options, pattern, n, dim, width, height, what, metric, made_by, measured_by)
) STRICT;

CREATE TABLE result (        -- one trial of a series
  id INTEGER PRIMARY KEY CHECK (id >= 0),  -- 2^32 trial + series, so that new rows are appended
  seed INTEGER NOT NULL,                   -- of koksma_generate or koksma_render, as a signed 64-bit number
  v0 REAL CHECK (abs(v0) < 9e999),         -- value of the measure; for an image the mean over the pixels of the absolute
                                           -- error in luminance; for a coherence the peak of the error's power
                                           -- spectrum divided by its mean, 0 without an error; the value of a metric
  v1 REAL CHECK (abs(v1) < 9e999),         -- for an image the SD of the absolute error; for a coherence p, the
                                           -- probability that white noise has as large a peak; the metric without the
                                           -- 0.1 % of the pixels with the largest errors
  v2 REAL CHECK (abs(v2) < 9e999),         -- the error's maximum; the peak's x frequency (1/pixel); these pixels' share,
                                           -- 0 to 1, of the sum of all errors
  v3 REAL CHECK (abs(v3) < 9e999)          -- the RMSE; the peak's y frequency; none of a metric
) STRICT;

CREATE TABLE reference (     -- the errors of reference images
  scene TEXT NOT NULL,
  scene_hash TEXT NOT NULL,
  options TEXT NOT NULL,
  width INTEGER NOT NULL CHECK (width > 0),
  height INTEGER NOT NULL CHECK (height > 0),
  reference TEXT NOT NULL,
  made_by TEXT NOT NULL,                   -- revisions, as in table series
  standard_error REAL,                     -- the reference's own expected absolute error, mean over the pixels
  pixels TEXT NOT NULL CHECK (length(pixels) IN (0, 64)), -- SHA-256 of the pixels; '': from before schema 6
  PRIMARY KEY (scene, scene_hash, options, width, height, reference, made_by)
) STRICT, WITHOUT ROWID;

CREATE TABLE run (           -- when, where and how long a run wrote this file
  id INTEGER PRIMARY KEY,
  started TEXT NOT NULL,                   -- UTC
  machine TEXT NOT NULL,
  version TEXT NOT NULL,
  workers INTEGER NOT NULL,                -- threads, or MPI ranks
  jobs INTEGER NOT NULL,                   -- jobs completed in this run
  seconds REAL NOT NULL,
  idle_seconds REAL NOT NULL,              -- time without a job, summed over all workers
  processor_seconds REAL NOT NULL,         -- summed over all threads and ranks
  store_seconds REAL NOT NULL              -- the part of processor_seconds spent in this database
) STRICT;

CREATE TABLE failed (        -- jobs that failed without ending the run, and why (study/run/failed_jobs.c)
  id INTEGER PRIMARY KEY,
  label TEXT NOT NULL,                     -- the pattern, and what else tells the jobs but n
  n INTEGER NOT NULL,
  failed INTEGER NOT NULL CHECK (failed > 0), -- trials that failed, of `trials`
  trials INTEGER NOT NULL,
  reason TEXT NOT NULL,                    -- of the first of them
  UNIQUE (label, n, reason)
) STRICT;

CREATE TABLE left_out (      -- what was left out: lines on the plan's blocks with `skip`, and on failed jobs
  id INTEGER PRIMARY KEY,
  line TEXT NOT NULL
) STRICT;

CREATE VIEW rows AS
  SELECT kind, scene, scene_hash, options, pattern, n, dim, width, height, what, result.id >> 32 AS trial, seed,
         v0 AS value,
         CASE kind WHEN 'image' THEN v1 END AS sd,
         CASE kind WHEN 'image' THEN v2 END AS max,
         CASE kind WHEN 'image' THEN v3 END AS rmse,
         CASE kind WHEN 'coherence' THEN v1 END AS p,
         CASE kind WHEN 'coherence' THEN v2 END AS frequency_x,
         CASE kind WHEN 'coherence' THEN v3 END AS frequency_y,
         CASE kind WHEN 'metric' THEN v1 END AS robust,
         CASE kind WHEN 'metric' THEN v2 END AS top_share,
         metric, made_by, measured_by
  FROM result JOIN series ON series.id = result.id & 4294967295
  WHERE v0 IS NOT NULL;
