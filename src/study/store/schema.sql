-- The results of studies, schema 6 (user_version; application_id 1263236977, "Kksm" in the header of the file). Text
-- names never change meaning. Numbers are the doubles that were computed, bit for bit. `SELECT * FROM rows` shows
-- everything with its key. Koksma opens a file that has exactly these tables and nothing else.

CREATE TABLE meta (          -- what made this file: 'plan', 'plan-texts', 'plan-text-0' and 'plan-name-0' and on; its 'seal'
  key TEXT PRIMARY KEY,                    -- seal: "N SUM", how many rows meta (all but this), series, result and
  value TEXT NOT NULL                      -- reference have, and the sum of their checksums (seal.c)
) STRICT, WITHOUT ROWID;

CREATE TABLE series (        -- what is measured, all but the trial: one row a mean in a table
  id INTEGER PRIMARY KEY CHECK (id BETWEEN 1 AND 67108864), -- of an image a multiple of 4; measures of the same point
                                           -- sets follow it
  kind TEXT NOT NULL CHECK (kind IN ('discrepancy', 'image', 'coherence')), -- coherence: of an image's error
  scene TEXT NOT NULL,                     -- '' for discrepancies, as the next
  scene_hash TEXT NOT NULL,                -- of the scene's text, and of the points of a file: pattern, hexadecimal
  options TEXT NOT NULL,                   -- what differs from the defaults: pairing=aligned, warp=polar-disk
  pattern TEXT NOT NULL,                   -- canonical spec, e.g. poisson-disk:d=0.2
  n INTEGER NOT NULL CHECK (n > 0),        -- points, or samples a pixel
  dim INTEGER NOT NULL CHECK (dim >= 0),   -- 0 for images
  width INTEGER NOT NULL CHECK (width >= 0), -- 0 for discrepancies, as the next
  height INTEGER NOT NULL CHECK (height >= 0),
  what TEXT NOT NULL,                      -- the measure's canonical spec, or the reference: name:pattern@spp x replicates
  made_by TEXT NOT NULL,                   -- revisions: random 0; renderer 0, n-rooks 0 (src/study/plan/made_by.h)
  measured_by TEXT NOT NULL,               -- of the measure and warp; of the reference image as made_by
  UNIQUE (kind, scene, scene_hash, options, pattern, n, dim, width, height, what, made_by, measured_by)
) STRICT;

CREATE TABLE result (        -- up to four measures of one point set, or one render and one reference
  id INTEGER PRIMARY KEY CHECK (id >= 0 AND id & 3 = 0), -- 2^32 trial + series, a multiple of 4: rows are appended
                                           -- as they are made
  seed INTEGER NOT NULL,                   -- of koksma_generate or koksma_render, as a signed 64-bit number
  v0 REAL CHECK (abs(v0) < 9e999),         -- that series' measure; of an image the mean over the pixels of the absolute
                                           -- error in luminance; of a coherence the peak of the error's power spectrum
                                           -- over the mean, 0 without an error
  v1 REAL CHECK (abs(v1) < 9e999),         -- the measure of series + 1; of an image the SD of the absolute error; of a
                                           -- coherence p, the probability that white noise has as large a one
  v2 REAL CHECK (abs(v2) < 9e999),         -- series + 2; the error's maximum; the peak's frequency in x, cycles a pixel
  v3 REAL CHECK (abs(v3) < 9e999)          -- series + 3; the root of the mean square; the frequency in y
) STRICT;

CREATE TABLE reference (     -- how good a reference image is
  scene TEXT NOT NULL,
  scene_hash TEXT NOT NULL,
  options TEXT NOT NULL,
  width INTEGER NOT NULL CHECK (width > 0),
  height INTEGER NOT NULL CHECK (height > 0),
  reference TEXT NOT NULL,
  made_by TEXT NOT NULL,                   -- revisions, as in table series
  standard_error REAL,                     -- mean over the pixels of the reference's own expected absolute error
  pixels TEXT NOT NULL CHECK (length(pixels) IN (0, 64)), -- their SHA-256 (reference_image.h); '': from before schema 6
  PRIMARY KEY (scene, scene_hash, options, width, height, reference, made_by)
) STRICT, WITHOUT ROWID;

CREATE TABLE run (           -- when, where and how long somebody worked on this file
  id INTEGER PRIMARY KEY,
  started TEXT NOT NULL,                   -- UTC
  machine TEXT NOT NULL,
  version TEXT NOT NULL,
  workers INTEGER NOT NULL,                -- threads, or MPI ranks
  jobs INTEGER NOT NULL,                   -- done in this run
  seconds REAL NOT NULL,
  idle_seconds REAL NOT NULL,              -- of all workers together, without a job in hand
  processor_seconds REAL NOT NULL,         -- of all threads and ranks
  store_seconds REAL NOT NULL              -- of processor_seconds, in this database
) STRICT;

CREATE VIEW rows AS
  SELECT kind, scene, scene_hash, options, pattern, n, dim, width, height, what, result.id >> 32 AS trial, seed,
         CASE series.id & 3 WHEN 0 THEN v0 WHEN 1 THEN v1 WHEN 2 THEN v2 ELSE v3 END AS value,
         CASE kind WHEN 'image' THEN v1 END AS sd,
         CASE kind WHEN 'image' THEN v2 END AS max,
         CASE kind WHEN 'image' THEN v3 END AS rmse,
         CASE kind WHEN 'coherence' THEN v1 END AS p,
         CASE kind WHEN 'coherence' THEN v2 END AS frequency_x,
         CASE kind WHEN 'coherence' THEN v3 END AS frequency_y,
         made_by, measured_by
  FROM result JOIN series ON series.id BETWEEN result.id & 4294967295 AND (result.id & 4294967295) + 3
  WHERE value IS NOT NULL;
