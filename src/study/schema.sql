-- The results of studies. Text names never change meaning. Numbers are the doubles that were computed, bit for bit.
-- `SELECT * FROM rows` shows everything with its key.

CREATE TABLE IF NOT EXISTS meta (          -- what made this file: 'schema', 'version', 'plan', and the plan's text
  key TEXT PRIMARY KEY,
  value TEXT NOT NULL
) WITHOUT ROWID;

CREATE TABLE IF NOT EXISTS series (        -- what is measured, all but the trial: one row a mean in a table
  id INTEGER PRIMARY KEY,
  kind TEXT NOT NULL,                      -- 'discrepancy' or 'image'
  scene TEXT NOT NULL,                     -- '' for discrepancies, as the next
  scene_hash TEXT NOT NULL,                -- of the scene's text, hexadecimal
  options TEXT NOT NULL,                   -- what differs from the defaults: pairing=aligned, warp=polar-disk
  pattern TEXT NOT NULL,                   -- canonical spec, e.g. poisson-disk:d=0.2
  n INTEGER NOT NULL,                      -- points, or samples a pixel
  dim INTEGER NOT NULL,                    -- 0 for images
  width INTEGER NOT NULL,                  -- 0 for discrepancies, as the next
  height INTEGER NOT NULL,
  what TEXT NOT NULL,                      -- the measure's canonical spec, or the reference: name:pattern@spp x replicates
  UNIQUE (kind, scene, scene_hash, options, pattern, n, dim, width, height, what)
);

CREATE TABLE IF NOT EXISTS result (        -- one measure of one point set, or one render compared with one reference
  id INTEGER PRIMARY KEY,                  -- 2^32 trial + series: rows are appended as they are made
  seed INTEGER NOT NULL,                   -- of koksma_generate or koksma_render, as a signed 64-bit number
  value REAL NOT NULL,                     -- the measure, or the mean of the absolute error in luminance over the pixels
  sd REAL,                                 -- of an image: of the absolute error over the pixels
  max REAL,
  rmse REAL
);

CREATE TABLE IF NOT EXISTS reference (     -- how good a reference image is
  scene TEXT NOT NULL,
  scene_hash TEXT NOT NULL,
  options TEXT NOT NULL,
  width INTEGER NOT NULL,
  height INTEGER NOT NULL,
  reference TEXT NOT NULL,
  standard_error REAL,                     -- mean over the pixels of the reference's own expected absolute error
  PRIMARY KEY (scene, scene_hash, options, width, height, reference)
) WITHOUT ROWID;

CREATE TABLE IF NOT EXISTS run (           -- when, where and how long somebody worked on this file
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
);

CREATE VIEW IF NOT EXISTS rows AS
  SELECT kind, scene, scene_hash, options, pattern, n, dim, width, height, what, result.id >> 32 AS trial, seed, value,
         sd, max, rmse
  FROM result JOIN series ON series.id = result.id & 4294967295;
