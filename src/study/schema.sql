-- The results of studies. Text names never change meaning; a row's key is all columns before `seed`.
-- Numbers are the doubles that were computed, bit for bit.

CREATE TABLE IF NOT EXISTS meta (          -- what made this file: 'schema', 'version', 'plan'
  key TEXT PRIMARY KEY,
  value TEXT NOT NULL
) WITHOUT ROWID;

CREATE TABLE IF NOT EXISTS discrepancy (   -- one measure of one point set
  pattern TEXT NOT NULL,                   -- canonical spec, e.g. poisson-disk:d=0.2
  n INTEGER NOT NULL,
  dim INTEGER NOT NULL,
  measure TEXT NOT NULL,                   -- canonical spec, e.g. extreme:grid=20
  trial INTEGER NOT NULL,
  seed INTEGER NOT NULL,                   -- of koksma_generate, as a signed 64-bit number
  value REAL NOT NULL,
  PRIMARY KEY (pattern, n, dim, measure, trial)
) WITHOUT ROWID;

CREATE TABLE IF NOT EXISTS image_error (   -- one render compared with one reference
  scene TEXT NOT NULL,
  scene_hash TEXT NOT NULL,                -- of the scene's text, hexadecimal
  pattern TEXT NOT NULL,
  spp INTEGER NOT NULL,
  width INTEGER NOT NULL,
  height INTEGER NOT NULL,
  reference TEXT NOT NULL,                 -- name:pattern@spp x replicates
  trial INTEGER NOT NULL,
  seed INTEGER NOT NULL,                   -- of koksma_render, as a signed 64-bit number
  mean REAL NOT NULL,                      -- of the absolute error in luminance over the pixels
  sd REAL NOT NULL,
  max REAL NOT NULL,
  rmse REAL NOT NULL,
  PRIMARY KEY (scene, scene_hash, pattern, spp, width, height, reference, trial)
) WITHOUT ROWID;

CREATE TABLE IF NOT EXISTS reference (     -- how good a reference image is
  scene TEXT NOT NULL,
  scene_hash TEXT NOT NULL,
  reference TEXT NOT NULL,
  standard_error REAL,                     -- mean over the pixels of the reference's own expected absolute error
  PRIMARY KEY (scene, scene_hash, reference)
) WITHOUT ROWID;
